#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <set>
#include <span>
#include <vector>

namespace scantrove {

/// What the mask of a view, or most views of an entry, shows.
enum class CatalogueVerdict {
  whole,       ///< one true object: intersection over union above 0.6
  part,        ///< nearly nothing but one true object, and not all of it
  merger,      ///< several true objects, or an object and what is not its
  background,  ///< mostly what is no object, or nothing that is annotated
};

/// One view held against the truth of its frame.
struct ViewJudgment {
  CatalogueVerdict verdict = CatalogueVerdict::background;
  std::vector<int>
      instances;  ///< of what it is: one for whole and part; else all with a share, largest first
};

/// `mask` (255 = object) fills `box` of the frame, both in pixels of `truth` (as toLabelGrid takes it; 0 =
/// not annotated); the part of the box outside the image is left out. `objects`: the instances that are
/// objects. Background: at least half of the mask is no object. Part: at least three quarters are one object.
/// Instances with less than 15 % of the mask are not named.
[[nodiscard]] ViewJudgment judgeView(const cv::Mat& mask, const cv::Rect& box, const cv::Mat& truth,
                                     const std::set<int>& objects);

/// An entry of the catalogue by its views.
struct EntryJudgment {
  CatalogueVerdict verdict = CatalogueVerdict::background;
  std::vector<int> instances;
  int views = 0;
  int whole_views = 0;  ///< that show the one object which most whole views show
};

/// Whole: at least 80 % of the views are, of one and the same object. Else the verdict of most of the other
/// views.
[[nodiscard]] EntryJudgment judgeEntry(std::span<const ViewJudgment> views);

/// What a catalogue could have found.
struct TrueObject {
  int frames = 0;         ///< that show at least 400 pixels of it at 640 x 480, in proportion at other sizes
  double extent_m = 0;    ///< its longest side; 0 = not known
  int entire_frames = 0;  ///< of those, in which the image's border does not cut it
};

/// An object of 5 to 60 cm, seen in 30 frames or more.
[[nodiscard]] bool shouldBeFound(const TrueObject& object);

/// One that should be found and was entirely in the image for 30 frames or more.
[[nodiscard]] bool wasSeenEntirely(const TrueObject& object);

/// Counts the frame for the instances that it shows enough of.
void countVisible(const cv::Mat& truth, std::map<int, TrueObject>& objects);

struct CatalogueMetrics {
  double purity = 0;        ///< share of the entries that are whole; 0 where there are none
  double completeness = 0;  ///< share of the objects that should be found and are; 0 where there are none
  int entries = 0;
  int whole = 0;
  int expected = 0;                   ///< objects that should be found
  std::vector<int> missing;           ///< those that were not
  int seen_entirely = 0;              ///< expected objects that were in the image as a whole for long enough
  double completeness_of_entire = 0;  ///< share of those that are found; 0 where there are none
  int duplicates = 0;                 ///< whole entries beyond the first of their object
};

[[nodiscard]] CatalogueMetrics evaluateCatalogue(std::span<const EntryJudgment> entries,
                                                 const std::map<int, TrueObject>& objects);

}  // namespace scantrove
