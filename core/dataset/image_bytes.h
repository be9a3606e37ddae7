#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// The image of a PNG's bytes, unchanged; empty if they are none.
[[nodiscard]] cv::Mat decodePng(const std::string& bytes);

/// Whether two images are of one size and type and the same in every pixel.
[[nodiscard]] bool isSameImage(const cv::Mat& a, const cv::Mat& b);

}  // namespace scantrove
