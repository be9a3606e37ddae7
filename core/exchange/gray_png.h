#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

namespace scantrove {

/// The bytes of a 16-bit grey PNG of `image` (CV_16UC1, not empty). For images of large even areas: every row
/// is stored as its difference to the row above and packed at the lowest level, several times as fast as
/// OpenCV's encoder. Any thread.
[[nodiscard]] std::string encodeGrayPng(const cv::Mat& image);

}  // namespace scantrove
