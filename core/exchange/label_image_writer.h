#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>

#include "core/base/result.h"

namespace scantrove {

/// Writes `labels` (`width * height`, row by row, 0 = unlabelled) as a 16-bit PNG of `output_size`, each
/// output pixel the nearest label (pixel centres at integers, see Intrinsics). Written beside and renamed.
/// Error: names `path`, or the id when one is above 65535, which 16 bits cannot hold.
Result<void> writeLabelImage(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                             int width, int height, cv::Size output_size);

/// Reads a label image: 16- or 8-bit, one channel; CV_16UC1. Error: names `path`.
[[nodiscard]] Result<cv::Mat> readLabelImage(const std::filesystem::path& path);

}  // namespace scantrove
