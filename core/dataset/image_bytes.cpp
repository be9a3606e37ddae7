#include "core/dataset/image_bytes.h"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace scantrove {

std::string encodeMaskPng(const cv::Mat& mask) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", mask, bytes, {cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE});
  return {bytes.begin(), bytes.end()};
}

cv::Mat decodePng(const std::string& bytes) {
  if (bytes.empty()) return {};
  return cv::imdecode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
}

bool isSameImage(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && !a.empty() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace scantrove
