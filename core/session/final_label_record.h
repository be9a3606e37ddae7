#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/session/saved_scan.h"

namespace scantrove {

/// A session's record of an image in labels-final/ that its scan wrote.
struct FinalLabelImage {
  int frame_index = 0;               ///< RgbdFrame::index; it names the file
  std::uint32_t depth_checksum = 0;  ///< of the frame's depth image: checksumOfDepth()
  float meters_per_unit = 0.001F;    ///< of the depth image
  std::uint32_t checksum = 0;        ///< CRC-32 of the file
  /// CRC-32 of the file that is about to replace it; else 0. After a crash the file has either checksum.
  std::uint32_t next_checksum = 0;
};

/// By frame index.
using FinalLabelRecord = std::vector<FinalLabelImage>;

/// The metadata key of the record.
inline constexpr const char* kFinalLabelsKey = "final labels";
[[nodiscard]] std::string finalLabelsToText(const FinalLabelRecord& record);
/// Empty: the session has no record, or a damaged one.
[[nodiscard]] FinalLabelRecord finalLabelsFrom(const SessionMetadata& metadata);

/// CRC-32 of the size and pixels of a CV_16UC1 image.
[[nodiscard]] std::uint32_t checksumOfDepth(const cv::Mat& depth);
/// Name of a frame's file in each folder of label images.
[[nodiscard]] std::string labelFileName(int frame_index);

}  // namespace scantrove
