#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace scantrove {

/// Frames a second assumed where a recording has numbers but no times: timestamp = number / 30.
inline constexpr double kFrameRateHz = 30.0;

/// Where the camera was at one moment.
struct StampedPose {
  double timestamp_s = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

using Trajectory = std::vector<StampedPose>;

}  // namespace scantrove
