#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"

namespace scantrove {

/// One pose of an Open3D/Redwood `.log` file: a line of numbers that starts with the frame's, then a 4x4
/// matrix.
struct NumberedPose {
  int number = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// Reads `t tx ty tz qx qy qz qw` lines (TUM; `#` comments), sorted by time. Skips lines with NaN or Inf,
/// which a tracker writes while lost. Error: names the file and the malformed line, or an empty file.
[[nodiscard]] Result<Trajectory> readTumTrajectory(const std::filesystem::path& file);

/// Reads 5-line blocks (Open3D, Redwood; camera-to-world), in file order. Skips blocks that are no rigid
/// motion.
[[nodiscard]] Result<std::vector<NumberedPose>> readTrajectoryLog(const std::filesystem::path& file);

/// Reads sixteen numbers, row by row, finite or not. Error: names the file.
[[nodiscard]] Result<Eigen::Matrix4d> readMatrixFile(const std::filesystem::path& file);

/// Reads one 4x4 camera-to-world matrix (7-Scenes `*.pose.txt`). Error: unreadable, NaN or Inf, no rigid
/// motion.
[[nodiscard]] Result<Eigen::Isometry3d> readPoseFile(const std::filesystem::path& file);

/// The nearest rigid motion to `matrix`; empty if an element is not finite or the rotation part is not a
/// rotation within 0.02.
[[nodiscard]] std::optional<Eigen::Isometry3d> rigidMotion(const Eigen::Matrix4d& matrix);
/// The same of a rotation and a translation.
[[nodiscard]] std::optional<Eigen::Isometry3d> rigidMotion(const Eigen::Matrix3d& rotation,
                                                           const Eigen::Vector3d& translation);

}  // namespace scantrove
