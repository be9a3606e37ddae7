#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/evaluation/segmentation_metrics.h"

namespace scantrove {

/// Metrics of the label images in `estimate` that have one of the same number in `truth`: their mean, and
/// each.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateEstimate(const std::string& estimate,
                                                              const std::string& truth,
                                                              const SegmentationMetricOptions& options);

/// A scan with label images, and the truth of its frames.
struct JudgedScan {
  std::string scan;
  std::string truth;
};

/// Single frames, regions as known at each frame, and regions as known at the end of the same scans, over all
/// frames that have a truth; and single and merged over the number of frames that had been merged (thesis
/// fig. 4.9).
[[nodiscard]] Result<nlohmann::ordered_json> evaluateScans(const std::vector<JudgedScan>& scans,
                                                           const SegmentationMetricOptions& options);

}  // namespace scantrove
