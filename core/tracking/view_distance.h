#pragma once
#include <Eigen/Geometry>
#include <algorithm>

namespace scantrove {

/// Limits of rotation and translation between two views.
struct ViewReach {
  double angle_rad;
  double distance_m;
};

/// Rotation or translation between two views relative to `reach`, whichever is larger.
[[nodiscard]] inline double viewDistance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                                         const ViewReach& reach) {
  const Eigen::Isometry3d motion = a.inverse() * b;
  return std::max(Eigen::AngleAxisd(motion.linear()).angle() / reach.angle_rad,
                  motion.translation().norm() / reach.distance_m);
}

}  // namespace scantrove
