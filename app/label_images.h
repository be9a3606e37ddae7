#pragma once
#include <filesystem>
#include <map>

#include "core/base/result.h"
#include "core/evaluation/segmentation_metrics.h"

namespace scantrove {

/// Label images by the number of their frame, in order.
using NumberedImages = std::map<long, std::filesystem::path>;

/// The PNGs of a folder by the last number in their names (000012.png, img-12-label.png); of a recording with
/// truth, only its frame-NNNNNN.instance.png. Error: the folder is missing, or two have one number.
[[nodiscard]] Result<NumberedImages> numberedImages(const std::filesystem::path& folder);

/// The label image as the metrics take it. Error: names `path`.
[[nodiscard]] Result<SegmentationMetrics> evaluateLabelImage(const std::filesystem::path& path,
                                                             const cv::Mat& truth,
                                                             const SegmentationMetricOptions& options);

}  // namespace scantrove
