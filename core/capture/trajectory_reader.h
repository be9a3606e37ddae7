#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"

namespace scantrove {

/// Reads camera-to-world poses, ordered by time, from a `path` of one of these kinds:
///  * a file of TUM lines `t tx ty tz qx qy qz qw` (`#` starts a comment);
///  * ICL-NUIM's `*.gt.freiburg`, the same with frame numbers; mirrored as in icl_nuim.h, timestamp = number
///  / 30;
///  * a .log file of 5-line blocks (Redwood, Open3D), timestamp = frame number / 30;
///  * a folder with one of these, groundtruth.txt, or 7-Scenes' frame-NNNNNN.pose.txt (timestamp = NNNNNN /
///  30), or a
///    trajectory.txt, or a trajectory.log in it or one folder below.
/// Micro- and nanoseconds in TUM lines, and milliseconds since 1970, become seconds. Skips poses that are not
/// finite. Error: names the file and line, or the files missing in the folder.
[[nodiscard]] Result<Trajectory> readTrajectory(const std::filesystem::path& path);

}  // namespace scantrove
