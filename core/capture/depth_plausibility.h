#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

namespace scantrove {

/// Median of the valid depths of an image (CV_16UC1, 0 = none), metres; empty if none is valid.
[[nodiscard]] std::optional<double> medianDepth(const cv::Mat& depth, double meters_per_unit);

/// Logs a warning that names --depth-scale if the median depth lies outside 0.2 - 8 m. A wrong scale is the
/// commonest mistake with recordings.
void warnOfImplausibleDepth(const cv::Mat& depth, double meters_per_unit, const std::string& source_name);

}  // namespace scantrove
