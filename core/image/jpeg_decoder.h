#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Decodes a JPEG to CV_8UC3, BGR (grey ones are spread, four inks mixed; rotation tags are ignored). Damage
/// that libjpeg would paint over with a warning is an error; what many cameras write without harm (padding
/// before a marker) is none. Nothing is printed. Error: `name` and libjpeg's reason.
[[nodiscard]] Result<cv::Mat> decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace scantrove
