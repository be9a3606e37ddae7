#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/detection_params.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/thumbnail_matcher.h"
#include "core/catalogue/view_index.h"
#include "core/compute/compute_context.h"

namespace scantrove {

/// One candidate to compare.
struct DetectionQuery {
  cv::Mat color;  ///< crop of the full-resolution frame, CV_8UC3 BGR
  cv::Mat mask;   ///< same size, CV_8UC1, 255 = object
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
  std::vector<ObjectId> guesses = {};  ///< objects that it may be, perhaps seen in part so far
};

struct DetectionMatch {
  ObjectId object;      ///< none: unknown
  ObjectId nearest;     ///< the best match, accepted or not; none: no object has similar size and colour
  float distance = 2;   ///< of the best view, warped SSD per element
  ObjectId guess = {};  ///< best match of DetectionQuery::guesses; none: no match possible
  float guess_distance = 2;
};

/// Nearest neighbour recognition over all views of the catalogue (thesis 5.2; Torralba et al. 2008): 32 x
/// 32 Lab thumbnails normalised per channel, 19 principal components for pruning, SSD with warping and
/// local shifts on the device. A view stays with the object that it was stored for; a table of merge roots
/// tells the current owner, so merging and deleting move no views. One thread, the compute context's; all
/// but create may throw cl::Error.
class Detector {
 public:
  [[nodiscard]] static Result<Detector> create(ComputeContext& compute);

  void setParams(const DetectionParams& params) { params_ = params; }

  /// Reserves room for so many views in total, which avoids repeated copying.
  void reserve(int views) { matcher_.reserve(views); }
  /// Takes effect with the next find. About 4 KB per view, nearly all on the device.
  void add(const StoredDescriptor& view);
  [[nodiscard]] int viewCount() const { return index_.size(); }

  /// Views of an object without a root match nothing.
  void setMergeRoot(const MergeRoot& entry) { index_.setMergeRoot(entry); }
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const { return index_.mergeRootOf(object); }

  /// Builds colour tables and device code ahead of their first use, which can take a second without the
  /// driver's cache.
  void warmUp();

  /// Compares all candidates of a frame in one batch; one match per query, in order, with the current owner
  /// of the best view.
  [[nodiscard]] std::vector<DetectionMatch> find(const std::vector<DetectionQuery>& queries);

 private:
  explicit Detector(ThumbnailMatcher matcher) : matcher_(std::move(matcher)) {}

  DetectionParams params_;
  ThumbnailMatcher matcher_;
  ViewIndex index_;
};

}  // namespace scantrove
