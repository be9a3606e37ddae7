#pragma once
#include "core/fusion/icp_system.h"
#include "core/fusion/pose_estimate.h"

namespace scantrove {

/// What is known when ICP has ended.
struct IcpOutcome {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  IcpSystem system;  ///< of the last pass, at the finest level
  IcpStep step;      ///< of the last pass
  int pixels = 0;    ///< of the finest level
};

/// Whether the pose may be trusted, with its figures. `motion`: from the pose of the model, in the camera's
/// frame. `searched`: the pose was found by trying many guesses. `depth_noise_m`: FusionParams. A far motion
/// and a search leave more room for a false minimum and so need more evidence: no pose is called `tracking`
/// that might corrupt the map.
[[nodiscard]] PoseEstimate judgePose(const IcpOutcome& outcome, const Eigen::Isometry3d& motion,
                                     bool searched, double depth_noise_m);

}  // namespace scantrove
