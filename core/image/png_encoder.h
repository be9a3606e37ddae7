#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

namespace scantrove {

/// Encodes a non-empty `image` as PNG: CV_8UC1, CV_16UC1, or CV_8UC3 as BGR. For speed it filters every row
/// by the row above and deflates runs at the lowest level. Throws std::runtime_error if the image exceeds
/// checkImageSize. Any thread.
[[nodiscard]] std::string encodePng(const cv::Mat& image);

/// The same for CV_8UC1 as indices into `palette`: red, green, blue of 1 to 256 colours. Every index must
/// have a colour.
[[nodiscard]] std::string encodePalettePng(const cv::Mat& indices,
                                           std::span<const std::array<std::uint8_t, 3>> palette);

}  // namespace scantrove
