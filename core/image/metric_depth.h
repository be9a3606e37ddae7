#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Reads a depth image of floating-point metres: TIFF, OpenEXR (.exr) or NumPy (.npy). Result: CV_32FC1, z in
/// metres, 0 = no reading (also for NaN, infinite and negative values). Error: names the file; damaged, or no
/// floating point.
[[nodiscard]] Result<cv::Mat> readMetricDepth(const std::filesystem::path& file);

/// Depth in metres (CV_32FC1, any value) with 0 in place of NaN, infinite and negative values.
[[nodiscard]] cv::Mat withoutInvalidDepth(const cv::Mat& metres);

/// Depth in metres (CV_32FC1, any value) in units of `meters_per_unit`: CV_16UC1, rounded. 0 = no reading:
/// also what is not finite, negative, or too far for 16 bits.
[[nodiscard]] cv::Mat toDepthUnits(const cv::Mat& metres, float meters_per_unit);

/// The unit for depth that was floating-point metres: a quarter of a millimetre, up to 16.38 m.
inline constexpr double kMetricUnitsPerMeter = 4000;

}  // namespace scantrove
