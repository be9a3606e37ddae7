#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace scantrove {

/// Encodes a non-empty `image` as PNG: CV_8UC1, CV_16UC1, or CV_8UC3 as BGR. For speed it filters every row
/// by the row above and deflates runs at the lowest level. Throws std::runtime_error if the image exceeds
/// checkImageSize. Any thread.
[[nodiscard]] std::string encodePng(const cv::Mat& image);

}  // namespace scantrove
