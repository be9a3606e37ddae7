#pragma once
#include <filesystem>
#include <span>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"

namespace scantrove {

/// One line `timestamp tx ty tz qx qy qz qw` a pose (TUM RGB-D benchmark), camera to world, qw >= 0.
/// Positions with 15 digits: seven decimals at UTM coordinates. Written beside and renamed. Error: names
/// `path`.
Result<void> writeTumTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses);

}  // namespace scantrove
