#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace scantrove {

/// The bytes of a PNG of `image`, not empty: CV_8UC1, CV_16UC1, or CV_8UC3 as BGR. For speed every row is
/// stored as its difference to the row above, deflated at the lowest level as runs. Throws std::runtime_error
/// where it is larger than images that are read (checkImageSize). Any thread.
[[nodiscard]] std::string encodePng(const cv::Mat& image);

}  // namespace scantrove
