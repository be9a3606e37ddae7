#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// The bytes of a PNG of a mask, CV_8UC1 of 0 and 255.
[[nodiscard]] std::string encodeMaskPng(const cv::Mat& mask);

/// Reads such bytes, or those of a 16-bit PNG, unchanged; empty if they are none.
[[nodiscard]] cv::Mat decodePng(const std::string& bytes);

/// Whether two images are of one size and type and the same in every pixel.
[[nodiscard]] bool isSameImage(const cv::Mat& a, const cv::Mat& b);

}  // namespace scantrove
