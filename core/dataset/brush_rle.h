#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace scantrove {

/// A mask (CV_8UC1, nonzero = inside) as Label Studio's brush: the run lengths of an RGBA image, row by row,
/// whose four channels are 255 inside and 0 outside.
///
/// Bits, highest first: 32 for the number of values (4 w h); 5 for the bits of a value less 1; four times 4
/// for the bits of a length, less 1. Then runs: 1 for "one value repeated"; 2 for which of the four sizes the
/// length has; the length less 1; the value. The last byte is filled with zeros. Requires 4 w h < 2^32.
[[nodiscard]] std::vector<std::uint8_t> brushRle(const cv::Mat& mask);

}  // namespace scantrove
