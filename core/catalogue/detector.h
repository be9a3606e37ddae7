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

/// One candidate to look up.
struct DetectionQuery {
  cv::Mat color;  ///< crop of the full-resolution frame, CV_8UC3 BGR
  cv::Mat mask;   ///< same size, CV_8UC1, 255 = object
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
  std::vector<ObjectId> guesses = {};  ///< of which this may be one, or the half of one that is known so far
};

struct DetectionMatch {
  ObjectId object;      ///< none: unknown
  ObjectId nearest;     ///< that, or what is most like it; none: nothing has that size and colour
  float distance = 2;   ///< of the best view, warped SSD per element
  ObjectId guess = {};  ///< of DetectionQuery::guesses, what is most like it; none: nothing could be it
  float guess_distance = 2;
};

/// Nearest neighbour recognition over all views of the catalogue (thesis 5.2; Torralba et al. 2008): 32 x 32
/// Lab thumbnails normalised per channel, 19 principal components to prune, SSD with warping and local shifts
/// on the device. A view keeps the object that it was stored for; a table says who holds that object's views
/// now, so that merging and deleting move no view. One thread, the compute context's; all but create may
/// throw cl::Error.
class Detector {
 public:
  [[nodiscard]] static Result<Detector> create(ComputeContext& compute);

  void setParams(const DetectionParams& params) { params_ = params; }

  /// Makes room for so many views in all: growing view by view would copy them.
  void reserve(int views) { matcher_.reserve(views); }
  /// The next find searches it. About 4 KB a view, nearly all of it on the device.
  void add(const StoredDescriptor& view);
  [[nodiscard]] int viewCount() const { return index_.size(); }

  /// Views of an object without a root match nothing.
  void setMergeRoot(const MergeRoot& entry) { index_.setMergeRoot(entry); }
  [[nodiscard]] ObjectId mergeRootOf(ObjectId object) const { return index_.mergeRootOf(object); }

  /// Colour tables and device code are made on first use, which takes a second where the driver has none of
  /// the code yet: now, not in the middle of a scan.
  void warmUp();

  /// All candidates of a frame in one batch; one match for each query, in order: who holds the best view.
  [[nodiscard]] std::vector<DetectionMatch> find(const std::vector<DetectionQuery>& queries);

 private:
  explicit Detector(ThumbnailMatcher matcher) : matcher_(std::move(matcher)) {}

  DetectionParams params_;
  ThumbnailMatcher matcher_;
  ViewIndex index_;
};

}  // namespace scantrove
