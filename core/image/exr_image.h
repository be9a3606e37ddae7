#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Reads one channel of an OpenEXR image to CV_32FC1, h x w of its data window: R (Record3D), else Z, else Y,
/// else the only channel. Error: names the file; damaged, too large (see image_header.h), deep, none of these
/// channels.
[[nodiscard]] Result<cv::Mat> readExrImage(const std::filesystem::path& file);

}  // namespace scantrove
