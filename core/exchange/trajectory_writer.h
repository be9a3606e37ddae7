#pragma once
#include <filesystem>
#include <span>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"

namespace scantrove {

/// Writes a pose a line, `timestamp tx ty tz qx qy qz qw` (TUM RGB-D benchmark), camera to world, qw >= 0.
/// Positions have 15 digits: seven decimals at UTM coordinates. Written atomically. Error: names `path`.
Result<void> writeTumTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses);

}  // namespace scantrove
