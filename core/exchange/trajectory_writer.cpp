#include "core/exchange/trajectory_writer.h"

#include <charconv>
#include <string>

#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

/// std::to_chars: printf would write decimal commas where the person's language does.
void append(std::string& text, double value, std::chars_format format, int digits) {
  char number[400];
  const auto [end, failure] = std::to_chars(number, number + sizeof number, value, format, digits);
  text.append(number, end);
}

void appendGeneral(std::string& text, double value) { append(text, value, std::chars_format::general, 9); }

}  // namespace

Result<void> writeTumTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : poses) {
    const Eigen::Vector3d t = pose.T_world_camera.translation();
    Eigen::Quaterniond q(pose.T_world_camera.linear());
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    append(text, pose.timestamp_s, std::chars_format::fixed, 6);
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += ' ';
      appendGeneral(text, value);
    }
    text += '\n';
  }
  return writeFileAtomically(path, text);
}

Result<void> writeKittiTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses) {
  std::string text;
  for (const StampedPose& pose : poses) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        if (row + column > 0) text += ' ';
        appendGeneral(text, pose.T_world_camera.matrix()(row, column));
      }
    }
    text += '\n';
  }
  return writeFileAtomically(path, text);
}

}  // namespace scantrove
