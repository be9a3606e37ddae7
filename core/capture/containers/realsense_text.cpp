#include "core/capture/containers/realsense_text.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/capture/pose_files.h"

namespace scantrove {

namespace {

/// The one number of a key.
std::optional<double> realsenseNumber(const std::string& text, const std::string& key) {
  const auto values = parseNumbers(realsenseValue(text, key));
  if (!values || values->size() != 1 || !std::isfinite(values->front())) return std::nullopt;
  return values->front();
}

}  // namespace

std::string realsenseValue(const std::string& text, const std::string& key) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    const std::string_view field(text.data() + at, end - at);
    const std::size_t equal = field.find('=');
    if (equal != std::string_view::npos && field.substr(0, equal) == key)
      return std::string(field.substr(equal + 1));
    at = end + 1;
  }
  return {};
}

std::optional<RosCameraInfo> realsenseCameraInfo(const std::string& text) {
  constexpr double kLargestSide = 16384;
  RosCameraInfo info;
  const auto width = realsenseNumber(text, "width"), height = realsenseNumber(text, "height");
  const auto fx = realsenseNumber(text, "fx"), fy = realsenseNumber(text, "fy");
  const auto cx = realsenseNumber(text, "ppx"), cy = realsenseNumber(text, "ppy");
  if (!width || !height || !fx || !fy || !cx || !cy) return std::nullopt;
  if (!(*width > 0 && *height > 0 && *width <= kLargestSide && *height <= kLargestSide)) return std::nullopt;
  info.width = static_cast<std::uint32_t>(*width);
  info.height = static_cast<std::uint32_t>(*height);
  info.K = {*fx, 0, *cx, 0, *fy, *cy, 0, 0, 1};
  info.model = realsenseValue(text, "model");
  info.D = parseNumbers(realsenseValue(text, "coeffs")).value_or(std::vector<double>());
  return info;
}

std::optional<Eigen::Isometry3d> realsenseTransform(const std::string& text) {
  const auto rotation = parseNumbers(realsenseValue(text, "rotation"));
  const auto translation = parseNumbers(realsenseValue(text, "translation"));
  if (!rotation || !translation || rotation->size() != 9 || translation->size() != 3) return std::nullopt;
  return rigidMotion(Eigen::Map<const Eigen::Matrix3d>(rotation->data()),
                     Eigen::Map<const Eigen::Vector3d>(translation->data()));
}

}  // namespace scantrove
