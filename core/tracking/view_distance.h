#pragma once
#include <Eigen/Geometry>
#include <algorithm>

namespace scantrove {

/// How far two views may be apart, either way.
struct ViewReach {
  double angle_rad;
  double distance_m;
};

/// How far apart two views are: 1 where they are turned or moved by `reach`, whichever is more of it.
[[nodiscard]] inline double viewDistance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                                         const ViewReach& reach) {
  const Eigen::Isometry3d motion = a.inverse() * b;
  return std::max(Eigen::AngleAxisd(motion.linear()).angle() / reach.angle_rad,
                  motion.translation().norm() / reach.distance_m);
}

}  // namespace scantrove
