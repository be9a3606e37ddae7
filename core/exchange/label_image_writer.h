#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Writes `labels` (of `size`, row by row, 0 = unlabelled) as a 16-bit grey PNG. Favours speed over size, as
/// it runs for every frame of a scan. The same labels give the same bytes. Written atomically. Error: names
/// `path`, or the id if one exceeds 65535, the 16-bit limit.
Result<void> writeLabelImage(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                             cv::Size size);

/// The bytes of such a file. Error: the id that exceeds 16 bits; names `path`.
[[nodiscard]] Result<std::string> encodeLabelImage(const std::filesystem::path& path,
                                                   std::span<const std::uint32_t> labels, cv::Size size);

/// Reads a label image: 16- or 8-bit, one channel; CV_16UC1. Error: names `path`.
[[nodiscard]] Result<cv::Mat> readLabelImage(const std::filesystem::path& path);

}  // namespace scantrove
