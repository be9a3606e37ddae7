#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Reads a colour image as CV_8UC3, BGR (grey ones are spread over three channels; rotation tags are
/// ignored). Error: names the file; unreadable, truncated, damaged.
[[nodiscard]] Result<cv::Mat> readColorImage(const std::filesystem::path& file);

/// Reads a depth image as CV_16UC1 in the file's units, with 65535 (7-Scenes' "invalid", a saturated value
/// elsewhere) replaced by 0. Error: names the file; unreadable, truncated, damaged, or not one channel of 16
/// bits.
[[nodiscard]] Result<cv::Mat> readDepthImage(const std::filesystem::path& file);

}  // namespace scantrove
