#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Reads an image that NumPy saved (.npy): h x w, or with one more dimension of size 1. Result: CV_8UC1 and
/// CV_16UC1 for unsigned numbers of one and two bytes, CV_32FC1 for floating point of two, four and eight
/// bytes; of either byte order. Error: names the file; another type or shape, too large (see image_header.h),
/// truncated.
[[nodiscard]] Result<cv::Mat> readNumpyImage(const std::filesystem::path& file);

}  // namespace scantrove
