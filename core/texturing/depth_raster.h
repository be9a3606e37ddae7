#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// Draws triangles into a depth image; the nearest surface is visible.
class DepthRaster {
 public:
  explicit DepthRaster(const Intrinsics& K);

  /// Corners in the camera's frame, metres; both sides are drawn. A triangle with a corner less than 1 cm
  /// in front of the camera's plane is skipped.
  void add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c);

  /// CV_32FC1, metres along the optical axis, 0 = nothing.
  [[nodiscard]] const cv::Mat& depth() const { return depth_m_; }

 private:
  Intrinsics K_;
  cv::Mat depth_m_;
};

}  // namespace scantrove
