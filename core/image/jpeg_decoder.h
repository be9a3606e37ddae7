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

/// The header of a JPEG; empty if it is not among the bytes, damaged or of more than 8 bits a channel.
[[nodiscard]] std::optional<JpegHeader> readJpegHeader(std::span<const std::uint8_t> bytes);

/// Decodes a JPEG to CV_8UC3, BGR. Grey is spread, CMYK is mixed without a color profile, rotation tags are
/// ignored. TurboJPEG warns and paints grey where pixels are damaged or missing: such a warning is an error
/// here. Padding between markers, which many cameras write, is none. Error: `name` and TurboJPEG's reason.
[[nodiscard]] Result<cv::Mat> decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace scantrove
