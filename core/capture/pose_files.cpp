#include "core/capture/pose_files.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/text.h"
#include "core/base/text_file.h"

namespace scantrove {

namespace {

constexpr double kRotationTolerance = 0.02;  // 7-Scenes and Redwood round their matrices

Eigen::Matrix4d rowMajor4x4(std::span<const double> values) {
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
}

bool allFinite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

std::optional<Eigen::Isometry3d> rigidMotion(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::RowVector4d last_row(0, 0, 0, 1);
  if ((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() >
          kRotationTolerance ||
      rotation.determinant() < 0 || (matrix.row(3) - last_row).cwiseAbs().maxCoeff() > kRotationTolerance) {
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = svd.matrixU() * svd.matrixV().transpose();
  motion.translation() = matrix.topRightCorner<3, 1>();
  return motion;
}

std::optional<Eigen::Isometry3d> rigidMotion(const Eigen::Matrix3d& rotation,
                                             const Eigen::Vector3d& translation) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation;
  matrix.topRightCorner<3, 1>() = translation;
  return rigidMotion(matrix);
}

Result<Trajectory> readTumTrajectory(const std::filesystem::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) {
    return fail(text.error());
  }
  Trajectory trajectory;
  bool has_lines = false;
  int line_number = 0;
  for (const std::string_view raw_line : splitLines(*text)) {
    ++line_number;
    const std::string_view line = trimmed(raw_line.substr(0, raw_line.find('#')));
    if (line.empty()) {
      continue;
    }
    has_lines = true;
    const auto values = parseNumbers(line);
    if (!values || values->size() != 8) {
      return fail(file.string() + ", line " + std::to_string(line_number) +
                  " is not `t tx ty tz qx qy qz qw`.");
    }
    const std::vector<double>& v = *values;
    const Eigen::Quaterniond rotation(v[7], v[4], v[5], v[6]);
    if (!allFinite(v) || !(rotation.norm() > 1e-6)) {
      continue;
    }
    StampedPose pose{v[0], Eigen::Isometry3d::Identity()};
    pose.T_world_camera.linear() = rotation.normalized().toRotationMatrix();
    pose.T_world_camera.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
    trajectory.push_back(pose);
  }
  if (!has_lines) {
    return fail(file.string() + " holds no poses (lines `t tx ty tz qx qy qz qw`).");
  }
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.timestamp_s < b.timestamp_s; });
  return trajectory;
}

Result<std::vector<NumberedPose>> readTrajectoryLog(const std::filesystem::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) {
    return fail(text.error());
  }
  std::vector<std::string_view> lines = splitLines(*text);
  std::erase_if(lines, [](std::string_view line) { return trimmed(line).empty(); });
  if (lines.empty() || lines.size() % 5 != 0) {
    return fail(file.string() + " holds " + std::to_string(lines.size()) +
                " lines; a trajectory log has five for each pose (numbers, then a 4x4 matrix).");
  }
  std::vector<NumberedPose> poses;
  for (std::size_t block = 0; block < lines.size(); block += 5) {
    const auto header = parseNumbers(lines[block]);
    std::vector<double> matrix;
    for (std::size_t row = 1; row <= 4; ++row) {
      const auto values = parseNumbers(lines[block + row]);
      if (values && values->size() == 4) {
        matrix.insert(matrix.end(), values->begin(), values->end());
      }
    }
    if (!header || header->empty() || matrix.size() != 16 || !(std::abs((*header)[0]) < 1e9)) {
      return fail(file.string() + ": pose " + std::to_string(block / 5) +
                  " is not a line of numbers and a 4x4 matrix.");
    }
    if (const auto pose = rigidMotion(rowMajor4x4(matrix))) {
      poses.push_back({static_cast<int>((*header)[0]), *pose});
    }
  }
  return poses;
}

Result<Eigen::Matrix4d> readMatrixFile(const std::filesystem::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) {
    return fail(text.error());
  }
  const auto values = parseNumbers(*text);
  if (!values || values->size() != 16) {
    return fail(file.string() + " is not a 4x4 matrix.");
  }
  return rowMajor4x4(*values);
}

Result<Eigen::Isometry3d> readPoseFile(const std::filesystem::path& file) {
  const Result<Eigen::Matrix4d> matrix = readMatrixFile(file);
  if (!matrix) {
    return fail(matrix.error());
  }
  if (!matrix->allFinite()) {
    return fail(file.string() + " has values that are not finite (no pose was known for this frame).");
  }
  const auto pose = rigidMotion(*matrix);
  if (!pose) {
    return fail(file.string() + " is not a rigid motion.");
  }
  return *pose;
}

}  // namespace scantrove
