#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace scantrove {

/// Encodes `bgr` (CV_8UC3, not empty) as JPEG with 4:2:0 subsampling. `quality`: 1 to 100. Throws
/// std::runtime_error where TurboJPEG fails (more than 65,500 pixels in a row, no memory). Any thread.
[[nodiscard]] std::string encodeJpeg(const cv::Mat& bgr, int quality);

}  // namespace scantrove
