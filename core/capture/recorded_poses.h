#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>

#include "core/base/stamped_pose.h"

namespace scantrove {

/// The `trajectory.log` of a recording: in its folder, else in the first subfolder (by name) that has one;
/// empty if there is none.
[[nodiscard]] std::optional<std::filesystem::path> findTrajectoryLog(const std::filesystem::path& folder);

/// The pose at `timestamp_s` in a trajectory sorted by time. Interpolates (linear, slerp) between two poses
/// less than 0.1 s apart; else takes the nearest within 0.02 s; else nothing.
[[nodiscard]] std::optional<Eigen::Isometry3d> poseAt(const Trajectory& trajectory, double timestamp_s);

}  // namespace scantrove
