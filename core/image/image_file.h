#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Decodes a color image to CV_8UC3, BGR (grey ones are spread over three channels; rotation tags are
/// ignored): PNG by libspng, JPEG by TurboJPEG, PNM, BMP and TIFF by OpenCV. Error: names `name`; truncated,
/// damaged, too large (see image_header.h).
[[nodiscard]] Result<cv::Mat> decodeColorImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes an image of one channel as it is: depths, labels. (JPEGs, of which there are none, become BGR.)
/// Error: as above, or a PNG of more channels.
[[nodiscard]] Result<cv::Mat> decodeGrayImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes a depth image to CV_16UC1 in the file's units, with 65535 (7-Scenes' "invalid", a saturated value
/// elsewhere) replaced by 0. Error: as above, or not one channel of 16 bits.
[[nodiscard]] Result<cv::Mat> decodeDepthImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// The same of a file. Error: also what keeps it from being read; images that are too large are refused by
/// their header, before the rest is read.
[[nodiscard]] Result<cv::Mat> readColorImage(const std::filesystem::path& file);
[[nodiscard]] Result<cv::Mat> readGrayImage(const std::filesystem::path& file);
[[nodiscard]] Result<cv::Mat> readDepthImage(const std::filesystem::path& file);

}  // namespace scantrove
