#pragma once
#include <QImage>
#include <opencv2/core/mat.hpp>
#include <set>

#include "core/base/ids.h"

namespace scantrove {

/// Image of CV_8UC3 BGR pixels, which it shares; they must not change any more. Null if empty.
[[nodiscard]] QImage colorPicture(const cv::Mat& bgr);

/// Range of depths in a colour map, in metres; near is warm, far is cold.
struct DepthRange {
  float near_m = 0.4F;
  float far_m = 4.0F;
};

/// The range of the middle 96 % of the readings of CV_32FC1 depth; `fallback` if there are very few.
[[nodiscard]] DepthRange usualRange(const cv::Mat& depth_m, const DepthRange& fallback);

/// CV_32FC1 metres; 0 or NaN (no reading) becomes nearly black.
[[nodiscard]] QImage depthPicture(const cv::Mat& depth_m, const DepthRange& range);

/// The colour map from near to far, `width` x 1 pixels, for a legend.
[[nodiscard]] QImage depthLegend(int width);

/// CV_32SC1 ids in the colours of the 3D view, with thin dark lines between ids; 0 becomes nearly black. If
/// `highlight` is not empty, the other regions are dark.
[[nodiscard]] QImage regionPicture(const cv::Mat& region_ids, const std::set<RegionId>& highlight = {});
[[nodiscard]] QImage segmentPicture(const cv::Mat& segment_ids);

}  // namespace scantrove
