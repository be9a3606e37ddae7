#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// `depth_m` (CV_32FC1, metres) as CV_16UC1 in units of `meters_per_unit`, rounded; values out of range
/// become 0.
[[nodiscard]] cv::Mat depthInUnits(const cv::Mat& depth_m, float meters_per_unit);

}  // namespace scantrove
