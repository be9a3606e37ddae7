#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <set>
#include <span>
#include <vector>

namespace scantrove {

/// Verdict on the mask of a view, or on most views of an entry.
enum class CatalogueVerdict {
  complete,    ///< one true object: intersection over union above 0.6
  part,        ///< almost only one true object, but incomplete
  merger,      ///< several true objects, or an object and something else
  background,  ///< mostly no object, or not annotated
};

/// One view compared with the truth of its frame.
struct ViewJudgment {
  CatalogueVerdict verdict = CatalogueVerdict::background;
  std::vector<int> instances;  ///< one for complete and part; else all with a share, largest first
};

/// `mask` (255 = object) fills `box` of the frame, both in pixels of `truth` (as toLabelGrid takes it; 0 =
/// not annotated). Parts of the box outside the image are ignored. `objects`: the instances that are objects.
/// Background: at least half of the mask is no object. Part: at least three quarters are one object.
/// Instances with less than 15 % of the mask are ignored.
[[nodiscard]] ViewJudgment judgeView(const cv::Mat& mask, const cv::Rect& box, const cv::Mat& truth,
                                     const std::set<int>& objects);

/// An entry of the catalogue, judged by its views.
struct EntryJudgment {
  CatalogueVerdict verdict = CatalogueVerdict::background;
  std::vector<int> instances;
  int views = 0;
  int complete_views = 0;  ///< complete views of the object that most of them show
};

/// Complete if at least 80 % of the views are, all of the same object; else the verdict of most of the other
/// views.
[[nodiscard]] EntryJudgment judgeEntry(std::span<const ViewJudgment> views);

/// Visibility of an object that a catalogue could contain.
struct TrueObject {
  int frames = 0;         ///< frames that show at least 400 pixels of it at 640 x 480, scaled for other sizes
  double extent_m = 0;    ///< longest side; 0 = unknown
  int entire_frames = 0;  ///< frames of these in which the image border does not cut it
};

/// Expected: an object of 5 to 60 cm, seen in 30 frames or more.
[[nodiscard]] bool shouldBeFound(const TrueObject& object);

/// Expected, and entirely in the image for 30 frames or more.
[[nodiscard]] bool wasSeenEntirely(const TrueObject& object);

/// Counts the frame for each instance of which it shows enough.
void countVisible(const cv::Mat& truth, std::map<int, TrueObject>& objects);

struct CatalogueMetrics {
  double purity = 0;        ///< share of the entries that are complete; 0 where there are none
  double completeness = 0;  ///< share of the expected objects that are found; 0 where there are none
  int entries = 0;
  int complete = 0;
  int expected = 0;                   ///< number of expected objects
  std::vector<int> missing;           ///< expected objects not found
  int seen_entirely = 0;              ///< expected objects that were in the image as a whole for long enough
  double completeness_of_entire = 0;  ///< share of those that are found; 0 where there are none
  int duplicates = 0;                 ///< complete entries beyond the first of their object
};

[[nodiscard]] CatalogueMetrics evaluateCatalogue(std::span<const EntryJudgment> entries,
                                                 const std::map<int, TrueObject>& objects);

}  // namespace scantrove
