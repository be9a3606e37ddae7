#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

struct JpegHeader {
  cv::Size size;
  bool is_color = false;  ///< three channels
  bool is_cmyk = false;
};

/// Parses a JPEG's header; empty if it is incomplete, damaged or of more than 8 bits a channel.
[[nodiscard]] std::optional<JpegHeader> readJpegHeader(std::span<const std::uint8_t> bytes);

/// Decodes a JPEG to CV_8UC3, BGR. Grey is replicated, CMYK is converted without a colour profile,
/// orientation tags are ignored. TurboJPEG warns and fills damaged or missing pixels with grey: such a
/// warning is an error here. Padding between markers, which many cameras write, is not. Error: `name` and
/// TurboJPEG's reason.
[[nodiscard]] Result<cv::Mat> decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace scantrove
