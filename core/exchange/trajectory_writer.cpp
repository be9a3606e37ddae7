#include "core/exchange/trajectory_writer.h"

#include <charconv>
#include <string>

#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

/// Tenths of micrometres at UTM coordinates with up to eight digits before the point.
constexpr int kPositionDigits = 15;
constexpr int kRotationDigits = 9;

/// std::to_chars, because printf uses the locale's decimal commas.
void append(std::string& text, double value, std::chars_format format, int digits) {
  char number[400];
  const auto [end, failure] = std::to_chars(number, number + sizeof number, value, format, digits);
  text.append(number, end);
}

}  // namespace

Result<void> writeTumTrajectory(const std::filesystem::path& path, std::span<const StampedPose> poses) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : poses) {
    const Eigen::Vector3d t = pose.T_world_camera.translation();
    Eigen::Quaterniond q(pose.T_world_camera.linear());
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    append(text, pose.timestamp_s, std::chars_format::fixed, 6);
    for (const double value : {t.x(), t.y(), t.z()}) {
      text += ' ';
      append(text, value, std::chars_format::general, kPositionDigits);
    }
    for (const double value : {q.x(), q.y(), q.z(), q.w()}) {
      text += ' ';
      append(text, value, std::chars_format::general, kRotationDigits);
    }
    text += '\n';
  }
  return writeFileAtomically(path, text);
}

}  // namespace scantrove
