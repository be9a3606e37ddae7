#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/evaluation/segmentation_metrics.h"

namespace scantrove {

/// Metrics of the label images in `estimate` that have an image of the same number in `truth`: mean and each.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateEstimate(const std::string& estimate,
                                                              const std::string& truth,
                                                              const SegmentationMetricOptions& options);

/// Folders of a scan with label images and of its ground truth.
struct JudgedScan {
  std::string scan;
  std::string truth;
  bool with_estimated = false;  ///< average precision includes estimated points
};

/// Metrics over all frames with ground truth: of single frames, of regions as known at each frame, and of
/// regions at the end of the scan. Also single and merged by the number of merged frames (thesis fig. 4.9).
/// Average precision of the final regions as instances, if all scans have a cloud and truth with depth.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateScans(const std::vector<JudgedScan>& scans,
                                                           const SegmentationMetricOptions& options);

}  // namespace scantrove
