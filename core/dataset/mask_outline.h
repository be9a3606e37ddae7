#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace scantrove {

/// One closed polygon through the outermost pixels of a mask (CV_8UC1), for formats with one polygon per
/// object. Filled by the even-odd rule with its edge (as by cv::fillPoly) it reproduces the mask, with two
/// exceptions. Bridges one pixel wide join its parts and holes. Parts and holes below 2 % of it, or of fewer
/// than 9 pixels, are left out. Empty if the mask is empty or has no extent of three pixels.
[[nodiscard]] std::vector<cv::Point> outlineOf(const cv::Mat& mask);

}  // namespace scantrove
