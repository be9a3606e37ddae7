#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Reads a depth image of any type, which its content decides. Result, 0 = no reading:
///  * CV_16UC1 in the file's units: PNG, PGM (big endian), TIFF, NumPy integers of 16 bits. 65535 becomes 0;
///  * CV_32FC1 as the file has it, usually metres: float TIFF, OpenEXR, NumPy floats. NaN and infinity become
///  0.
/// Error: names the file; unreadable, damaged, too large, another type.
[[nodiscard]] Result<cv::Mat> readAnyDepth(const std::filesystem::path& file);

}  // namespace scantrove
