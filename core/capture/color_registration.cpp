#include "core/capture/color_registration.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace scantrove {
namespace {

/// Median of the readings on a grid of every 8th pixel; empty depth: infinitely far.
float inverseMedianDepth(const cv::Mat& depth, float metres_per_unit) {
  std::vector<std::uint16_t> readings;
  for (int row = 0; row < depth.rows; row += 8) {
    for (int column = 0; column < depth.cols; column += 8) {
      if (const auto reading = depth.at<std::uint16_t>(row, column); reading != 0)
        readings.push_back(reading);
    }
  }
  if (readings.empty()) return 0;
  const auto middle = readings.begin() + static_cast<std::ptrdiff_t>(readings.size() / 2);
  std::nth_element(readings.begin(), middle, readings.end());
  return 1.0F / (static_cast<float>(*middle) * metres_per_unit);
}

}  // namespace

cv::Mat registerColor(const cv::Mat& color, const ColorCamera& camera, const cv::Mat& depth,
                      float metres_per_unit, const Intrinsics& K) {
  // From the depth image's pixel to the colour image's, at the median depth.
  const float sx = camera.fx / K.fx;
  const float sy = camera.fy / K.fy;
  const float shift = camera.fx * camera.offset_x_m * inverseMedianDepth(depth, metres_per_unit);
  const cv::Matx23f to_color(sx, 0, camera.cx - sx * K.cx + shift, 0, sy, camera.cy - sy * K.cy);
  cv::Mat registered;
  cv::warpAffine(color, registered, to_color, {K.width, K.height}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return registered;
}

}  // namespace scantrove
