#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <span>
#include <utility>

#include "core/capture/intrinsics.h"
#include "core/compute/opencl.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// The surface in one depth image, small enough to store for every place: depths alone, in eighths of a
/// millimetre (to 8.1 m), from which vertices and normals are recomputed. Any thread.
class StoredSurface {
 public:
  StoredSurface() = default;
  /// `vertices_camera`: by pixel of `K`; w = 0: none.
  StoredSurface(const Intrinsics& K, std::span<const cl_float4> vertices_camera);

  /// `units`: units() of another surface.
  StoredSurface(const Intrinsics& K, cv::Mat units) : K_(K), units_(std::move(units)) {}

  [[nodiscard]] const Intrinsics& intrinsics() const { return K_; }
  /// CV_16UC1, 0 = none.
  [[nodiscard]] const cv::Mat& units() const { return units_; }
  [[nodiscard]] bool empty() const { return units_.empty(); }

  /// The view from its camera at `T_world_camera`. Vertices at outlines and depth jumps have no normals.
  [[nodiscard]] RenderedView render(const Eigen::Isometry3d& T_world_camera) const;

 private:
  Intrinsics K_;
  cv::Mat units_;
};

}  // namespace scantrove
