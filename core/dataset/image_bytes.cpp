#include "core/dataset/image_bytes.h"

#include <cstdint>
#include <opencv2/core.hpp>

#include "core/image/png_decoder.h"

namespace scantrove {

cv::Mat decodePng(const std::string& bytes) {
  if (bytes.empty()) return {};
  return decodeAnyPng({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "a mask")
      .value_or(cv::Mat());
}

bool isSameImage(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && !a.empty() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace scantrove
