#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace scantrove {

/// Where the camera was at one moment.
struct StampedPose {
  double timestamp_s = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

using Trajectory = std::vector<StampedPose>;

}  // namespace scantrove
