#pragma once
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"
#include "core/capture/containers/byte_cursor.h"

namespace scantrove {

/// Decodes RVL (Wilson 2017, Fast Lossless Depth Image Compression) to CV_16UC1. Error: damaged; has no name.
[[nodiscard]] Result<cv::Mat> decodeRvl(ByteView bytes, const cv::Size& size);

}  // namespace scantrove
