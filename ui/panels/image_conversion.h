#pragma once
#include <QImage>
#include <opencv2/core/mat.hpp>
#include <set>

#include "core/base/ids.h"

namespace scantrove {

/// CV_8UC3 BGR; shares the pixels (which nobody may write any more). Null when empty.
[[nodiscard]] QImage colorPicture(const cv::Mat& bgr);

/// Depths in metres that a colour map spans; near is warm, far is cold.
struct DepthRange {
  float near_m = 0.4F;
  float far_m = 4.0F;
};

/// The range that holds the middle 96 % of the readings of CV_32FC1 depth; `fallback` when there are hardly
/// any.
[[nodiscard]] DepthRange usualRange(const cv::Mat& depth_m, const DepthRange& fallback);

/// CV_32FC1 metres; 0 or NaN (no reading) becomes nearly black.
[[nodiscard]] QImage depthPicture(const cv::Mat& depth_m, const DepthRange& range);

/// The colour map itself, near to far, `width` x 1: for a legend.
[[nodiscard]] QImage depthLegend(int width);

/// CV_32SC1 ids in the colours of the 3D view, with thin dark lines between ids; 0 becomes nearly black.
/// When any are `lit`, the others are dark.
[[nodiscard]] QImage regionPicture(const cv::Mat& region_ids, const std::set<RegionId>& lit = {});
[[nodiscard]] QImage segmentPicture(const cv::Mat& segment_ids);

}  // namespace scantrove
