#pragma once
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/evaluation/segmentation_metrics.h"

namespace scantrove {

/// A label image of a scan and the true one of the same frame.
struct LabelImagePair {
  std::filesystem::path estimate;
  std::filesystem::path truth;
};

/// Pairs the PNGs of two folders by the last number in their names (000012.png with img-12-label.png).
/// Ordered by that number. Error: a folder is missing, or no pair was found.
[[nodiscard]] Result<std::vector<LabelImagePair>> pairLabelImages(const std::filesystem::path& estimate,
                                                                  const std::filesystem::path& truth);

/// Metrics of one pair; an estimate of another size is resized to the truth's (nearest label).
/// Error: an image cannot be read.
[[nodiscard]] Result<SegmentationMetrics> evaluatePair(const LabelImagePair& pair,
                                                       const SegmentationMetricOptions& options);

}  // namespace scantrove
