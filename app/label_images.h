#pragma once
#include <filesystem>
#include <map>

#include "core/base/result.h"
#include "core/evaluation/segmentation_metrics.h"

namespace scantrove {

/// Label images by frame number.
using NumberedImages = std::map<long, std::filesystem::path>;

/// The PNGs of a folder by the last number in their names (000012.png, img-12-label.png). Of a recording with
/// ground truth, only frame-NNNNNN.instance.png. Error: the folder is missing, or two images have the same
/// number.
[[nodiscard]] Result<NumberedImages> numberedImages(const std::filesystem::path& folder);

/// Metrics of the label image at `path`, resized to `truth` if needed. The error names `path`.
[[nodiscard]] Result<SegmentationMetrics> evaluateLabelImage(const std::filesystem::path& path,
                                                             const cv::Mat& truth,
                                                             const SegmentationMetricOptions& options);

}  // namespace scantrove
