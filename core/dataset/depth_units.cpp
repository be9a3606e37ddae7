#include "core/dataset/depth_units.h"

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

namespace scantrove {

cv::Mat depthInUnits(const cv::Mat& depth_m, float meters_per_unit) {
  cv::Mat units = cv::Mat::zeros(depth_m.size(), CV_16UC1);
  for (int y = 0; y < depth_m.rows; ++y) {
    for (int x = 0; x < depth_m.cols; ++x) {
      const float value = std::round(depth_m.at<float>(y, x) / meters_per_unit);
      if (value > 0 && value < 65535) units.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(value);
    }
  }
  return units;
}

}  // namespace scantrove
