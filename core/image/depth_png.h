#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Whether the bytes are a PNG as depth is stored: grey, 16 bits, not interlaced.
[[nodiscard]] bool isDepthPng(std::span<const std::uint8_t> bytes);

/// Decodes such a PNG to CV_16UC1; the same picture as OpenCV's, in about half the time (most of the work
/// on a frame's images is inflating its depth, and libdeflate does that four times as fast as zlib).
/// Checksums are verified. Error: `name` and what is damaged.
[[nodiscard]] Result<cv::Mat> decodeDepthPng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace scantrove
