#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// What a depth camera saw at one moment, small enough to be kept for every place: depths alone, in eighths
/// of a millimetre (to 8.1 m), from which vertices and normals are made again. Any thread.
class StoredSurface {
 public:
  StoredSurface() = default;
  /// `vertices_camera`: by pixel of `K`, w = 0: none.
  StoredSurface(const Intrinsics& K, std::span<const cl_float4> vertices_camera);

  /// `units`: as of another.
  StoredSurface(const Intrinsics& K, cv::Mat units) : K_(K), units_(std::move(units)) {}

  [[nodiscard]] const Intrinsics& intrinsics() const { return K_; }
  /// CV_16UC1, 0 = none.
  [[nodiscard]] const cv::Mat& units() const { return units_; }
  [[nodiscard]] bool empty() const { return units_.empty(); }

  struct Points {
    std::vector<cl_float4> vertices;  ///< (x, y, z, 1) by pixel, all 0 where there is none
    std::vector<cl_float4> normals;   ///< unit, towards the camera; all 0 at outlines and where depth jumps
  };
  /// In the frame that `T_world_camera` leads to.
  [[nodiscard]] Points seenFrom(const Eigen::Isometry3d& T_world_camera) const;

  /// The same as a model to register a frame against.
  void toDevice(const Eigen::Isometry3d& T_world_camera, ComputeContext& compute, SurfaceMaps& surface) const;

 private:
  Intrinsics K_;
  cv::Mat units_;
};

}  // namespace scantrove
