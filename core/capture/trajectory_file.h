#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/exchange/stamped_pose.h"

namespace scantrove {

/// One pose of an Open3D/Redwood `.log` file: a line of numbers of which the first is the frame's, then a 4x4
/// matrix.
struct NumberedPose {
  int number = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// Frames a second assumed where a recording has numbers but no times: timestamp = number / 30.
inline constexpr double kFrameRateHz = 30.0;

/// Reads `t tx ty tz qx qy qz qw` lines (TUM; `#` comments), sorted by time. Lines with NaN or Inf are left
/// out (the tracker that wrote them was lost). Error: names the file and the line that is something else, or
/// an empty file.
[[nodiscard]] Result<Trajectory> readTumTrajectory(const std::filesystem::path& file);

/// Reads 5-line blocks (Open3D, Redwood; camera-to-world), in file order. Blocks that are no rigid motion are
/// left out.
[[nodiscard]] Result<std::vector<NumberedPose>> readTrajectoryLog(const std::filesystem::path& file);

/// Reads one 4x4 camera-to-world matrix (7-Scenes `*.pose.txt`). Error: unreadable, NaN or Inf, no rigid
/// motion.
[[nodiscard]] Result<Eigen::Isometry3d> readPoseFile(const std::filesystem::path& file);

/// The trajectory log of a numbered folder (`trajectory.log`, also under `test_scene/`); empty if there is
/// none.
[[nodiscard]] std::optional<std::filesystem::path> findTrajectoryLog(const std::filesystem::path& folder);

/// The pose at `timestamp_s` in a trajectory sorted by time: between two poses less than 0.1 s apart
/// interpolated (linear, slerp); else the nearest one within 0.02 s; else nothing.
[[nodiscard]] std::optional<Eigen::Isometry3d> poseAt(const Trajectory& trajectory, double timestamp_s);

/// The nearest rigid motion to `matrix`; empty if an element is not finite or the rotation part is not a
/// rotation within 0.02.
[[nodiscard]] std::optional<Eigen::Isometry3d> rigidMotion(const Eigen::Matrix4d& matrix);

}  // namespace scantrove
