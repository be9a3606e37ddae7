#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Decodes any PNG to CV_8UC3, BGR: 16 bits are reduced to 8, grey is replicated, transparency is dropped.
/// Error: `name` and libspng's reason.
[[nodiscard]] Result<cv::Mat> decodeColorPng(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes a one-channel PNG to CV_8UC1 or CV_16UC1, interlaced or not. Error: `name` and libspng's reason;
/// or the number of channels if not one.
[[nodiscard]] Result<cv::Mat> decodeGrayPng(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes a one-channel PNG as decodeGrayPng does, and any other as decodeColorPng does.
[[nodiscard]] Result<cv::Mat> decodeAnyPng(std::span<const std::uint8_t> bytes, const std::string& name);

/// Decodes an 8-bit PNG of four channels to CV_8UC4, in the file's order: R, G, B, A, alpha not applied.
/// Error: `name` and libspng's reason, or that it has no four channels of 8 bits.
[[nodiscard]] Result<cv::Mat> decodeRgbaPng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace scantrove
