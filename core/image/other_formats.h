#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

enum class PictureWay : std::uint8_t {
  to_color,  ///< CV_8UC3, BGR; rotation tags are ignored
  as_it_is   ///< channels and depth as in the file
};

/// Decodes PNM, BMP and TIFF by OpenCV. Its codecs bring a hundred libraries with them (25 MB in memory), so
/// they are a library of their own, loaded here the first time. Error: `name` and why; the library is
/// missing. Any thread.
[[nodiscard]] Result<cv::Mat> decodeOtherFormat(std::span<const std::uint8_t> bytes, PictureWay way,
                                                const std::string& name);

}  // namespace scantrove
