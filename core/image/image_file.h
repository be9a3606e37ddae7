#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Decodes a colour image to CV_8UC3, BGR: PNG by libspng, JPEG by TurboJPEG, PNM, BMP and TIFF by OpenCV.
/// Grey is replicated over three channels; orientation tags are ignored. Error: names `name`; truncated,
/// damaged, too large (see image_header.h).
[[nodiscard]] Result<cv::Mat> decodeColorImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes a one-channel image unchanged: depths, labels. (JPEGs become BGR.) Error: as above, or a PNG of
/// more channels.
[[nodiscard]] Result<cv::Mat> decodeGrayImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes a depth image to CV_16UC1 in the file's units. 65535 (7-Scenes' "invalid", otherwise a saturated
/// value) becomes 0. Error: as above, or not one channel of 16 bits.
[[nodiscard]] Result<cv::Mat> decodeDepthImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// The same for a file. Error: also any reason why it cannot be read. The header is checked first, so images
/// that are too large are not read.
[[nodiscard]] Result<cv::Mat> readColorImage(const std::filesystem::path& file);
[[nodiscard]] Result<cv::Mat> readGrayImage(const std::filesystem::path& file);
[[nodiscard]] Result<cv::Mat> readDepthImage(const std::filesystem::path& file);

}  // namespace scantrove
