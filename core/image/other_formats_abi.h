#pragma once
#include <cstddef>
#include <cstdint>

/// What other_formats.cpp asks of the library that it loads. Into `image`, a cv::Mat, comes the picture, BGR
/// of 8 bits if `to_color`, else as it is. 0: that is so; else `reason`, of `reason_size` bytes, ends with a
/// zero.
using ScantroveDecodeOtherFormat = int(const std::uint8_t* bytes, std::size_t size, int to_color, void* image,
                                       char* reason, std::size_t reason_size);
#define SCANTROVE_DECODE_OTHER_FORMAT "scantroveDecodeOtherFormat"
