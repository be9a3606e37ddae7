#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/catalog/detection_params.h"
#include "core/catalog/object_record.h"
#include "core/compute/compute_context.h"

namespace scantrove {

/// One candidate to look up.
struct DetectionQuery {
  cv::Mat color;  ///< crop of the full-resolution frame, CV_8UC3 BGR
  cv::Mat mask;   ///< same size, CV_8UC1, 255 = object
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
};

struct DetectionMatch {
  ObjectId object;     ///< none: unknown
  float distance = 2;  ///< of the best view, warped SSD per element
};

/// Nearest neighbour recognition over all views of the catalogue (thesis 5.2; Torralba et al. 2008): 32 x 32
/// Lab thumbnails normalised per channel, 19 principal components to prune, SSD with warping and local shifts
/// on the device. One thread, the compute context's.
class Detector {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Detector>> create(ComputeContext& compute);
  ~Detector();

  void setParams(const DetectionParams& params);
  /// Adds a view; the next find searches it.
  void add(ObjectId object, const cv::Mat& color, const cv::Mat& mask, const Eigen::Vector3f& size_m);
  void add(ObjectId object, const Thumbnail& thumbnail, const Eigen::Vector3f& size_m);
  /// Forgets all views of an object (it was deleted or merged).
  void remove(ObjectId object);
  void clear();
  [[nodiscard]] int viewCount() const;

  /// All candidates of a frame in one batch; one match for each query, in order.
  [[nodiscard]] std::vector<DetectionMatch> find(const std::vector<DetectionQuery>& queries);

 private:
  Detector();
  class Machinery;
  std::unique_ptr<Machinery> machinery_;
};

}  // namespace scantrove
