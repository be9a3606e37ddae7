#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace scantrove {

/// The bytes of a JPEG of `bgr` (CV_8UC3, not empty). `quality`: 1 to 100, as libjpeg counts. Throws
/// std::runtime_error where libjpeg cannot (more than 65,500 pixels in a row, no memory). Any thread.
[[nodiscard]] std::string encodeJpeg(const cv::Mat& bgr, int quality);

}  // namespace scantrove
