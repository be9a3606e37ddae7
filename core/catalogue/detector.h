#pragma once
#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/detection_params.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/thumbnail_matcher.h"
#include "core/catalogue/view_index.h"
#include "core/compute/compute_context.h"

namespace scantrove {

class AppearanceNetwork;

/// One candidate to compare.
struct DetectionQuery {
  cv::Mat color;  ///< crop of the full-resolution frame, CV_8UC3 BGR
  cv::Mat mask;   ///< same size, CV_8UC1, 255 = object
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
  std::vector<ObjectId> guesses = {};  ///< objects that it may be, perhaps seen in part so far
};

struct DetectionMatch {
  ObjectId object;               ///< the nearest, if it is near and about as large; none: unknown
  ObjectId nearest;              ///< the best match, accepted or not; none: no object is similar at all
  float distance = 2;            ///< of the nearest object, judged by the runners-up (relativeDistance)
  ObjectId guess = {};           ///< best match of DetectionQuery::guesses; none: no match possible
  float guess_distance = 2;      ///< thumbnailDistance() of the guess's best view
  float nearest_distance = 2;    ///< objectDistance() of the nearest object
  float thumbnail_distance = 2;  ///< least thumbnailDistance() of the compared views of about this size
};

/// Nearest neighbour recognition over all views of the catalogue (thesis 5.2; Torralba et al. 2008): 32 x
/// 32 Lab thumbnails normalised per channel, 19 principal components for pruning, SSD with warping and
/// local shifts on the device; beside them histograms of the colours, the size and, if the user gave one, a
/// network (matchDistance). The nearest object must be nearer than its runners-up, and about as large. A
/// view stays with the object that it was stored for; a table of merge roots tells the current owner, so
/// merging and deleting move no views. One thread, the compute context's; all but create may throw cl::Error.
class Detector {
 public:
  /// `network`: an ONNX file, see AppearanceNetwork; empty: none. Error: of the network or the device.
  [[nodiscard]] static Result<Detector> create(ComputeContext& compute, const std::string& network = {});
  ~Detector();
  Detector(Detector&& other) noexcept;
  Detector& operator=(Detector&& other) noexcept;

  void setParams(const DetectionParams& params) { params_ = params; }

  /// Reserves room for so many views in total, which avoids repeated copying.
  void reserve(int views) { matcher_.reserve(views); }
  /// Takes effect with the next find. About 5 KB per view, most of it on the device. A vector of another
  /// network is ignored.
  void add(const StoredDescriptor& view);
  [[nodiscard]] int viewCount() const { return index_.size(); }

  /// Views of an object without a root match nothing.
  void setMergeRoot(const MergeRoot& entry) { index_.setMergeRoot(entry); }
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const { return index_.mergeRootOf(object); }

  /// Builds colour tables and device code ahead of their first use, which can take a second without the
  /// driver's cache.
  void warmUp();

  /// The descriptor of a new view. None: no colour or no object pixel.
  [[nodiscard]] std::optional<ViewDescriptor> describe(const cv::Mat& color, const cv::Mat& mask);

  /// Compares all candidates of a frame in one batch; one match per query, in order, with the current owner
  /// of the best view.
  [[nodiscard]] std::vector<DetectionMatch> find(const std::vector<DetectionQuery>& queries);

 private:
  /// A query, and the views that it is compared with.
  struct Compared {
    std::size_t query = 0;  // its index
    ViewDescriptor descriptor;
    std::vector<int> views, guessed_views;
  };

  explicit Detector(ThumbnailMatcher matcher);
  [[nodiscard]] ViewDifference difference(const ViewIndex::Query& query, int view, float shape) const;
  /// The distances of all objects that the views belong to. `shapes`: of the pairs with `views`.
  [[nodiscard]] std::map<ObjectId, float> distances(const ViewIndex::Query& query, std::span<const int> views,
                                                    std::span<const float> shapes) const;
  /// Fills the nearest object and its distances. `of_objects`: distances(); `objects`: countObjects().
  static void findNearest(std::map<ObjectId, float> of_objects, int objects, DetectionMatch& match);
  /// Accepts the nearest object where its size allows it. After findNearest().
  void acceptNearest(const ViewIndex::Query& query, std::span<const int> views, std::span<const float> shapes,
                     DetectionMatch& match) const;
  /// By the thumbnail alone and whatever the size, because the query perhaps shows only a part.
  void findGuess(const ViewIndex::Query& query, std::span<const int> views, std::span<const float> shapes,
                 DetectionMatch& match) const;

  DetectionParams params_;
  ThumbnailMatcher matcher_;
  ViewIndex index_;
  std::unique_ptr<AppearanceNetwork> network_;  // null: none
};

}  // namespace scantrove
