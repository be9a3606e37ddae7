#include "core/exchange/trajectory_writer.h"

#include <cstdio>
#include <string>

#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

void append(std::string& text, const char* format, double value) {
  char number[64];
  std::snprintf(number, sizeof number, format, value);
  text += number;
}

}  // namespace

Result<void> writeTumTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : poses) {
    const Eigen::Vector3d t = pose.T_world_camera.translation();
    Eigen::Quaterniond q(pose.T_world_camera.linear());
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    append(text, "%.6f", pose.timestamp_s);
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) append(text, " %.9g", value);
    text += '\n';
  }
  return writeFileAtomically(path, text);
}

Result<void> writeKittiTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses) {
  std::string text;
  for (const StampedPose& pose : poses) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        append(text, row + column == 0 ? "%.9g" : " %.9g", pose.T_world_camera.matrix()(row, column));
      }
    }
    text += '\n';
  }
  return writeFileAtomically(path, text);
}

}  // namespace scantrove
