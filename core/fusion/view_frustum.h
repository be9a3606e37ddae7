#pragma once
#include <Eigen/Geometry>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// A camera's view volume between two depths: all points that project onto one of its pixels.
class ViewFrustum {
 public:
  ViewFrustum(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K, double min_depth_m,
              double max_depth_m);

  /// False only if the sphere (world, metres) has no point in the frustum; may be true just outside its
  /// edges.
  [[nodiscard]] bool intersectsSphere(const Eigen::Vector3d& center_world, double radius_m) const;

  /// True only if the whole sphere lies in the frustum.
  [[nodiscard]] bool holdsSphere(const Eigen::Vector3d& center_world, double radius_m) const;

  [[nodiscard]] const Eigen::AlignedBox3d& boundsWorld() const { return bounds_world_; }

 private:
  [[nodiscard]] double smallestDistance(const Eigen::Vector3d& point_world) const;

  Eigen::Matrix<double, 6, 4> planes_world_;  ///< unit normals inwards: inside is where n . p + d >= 0
  Eigen::AlignedBox3d bounds_world_;
};

}  // namespace scantrove
