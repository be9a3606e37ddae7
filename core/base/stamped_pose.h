#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace scantrove {

/// Frame rate assumed for recordings with numbers but no times: timestamp = number / 30.
inline constexpr double kFrameRateHz = 30.0;

/// Camera pose at one moment.
struct StampedPose {
  double timestamp_s = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

using Trajectory = std::vector<StampedPose>;

}  // namespace scantrove
