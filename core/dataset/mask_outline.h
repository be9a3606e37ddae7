#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace scantrove {

/// One closed polygon through the outermost pixels of a mask (CV_8UC1), for formats with one polygon per
/// object. Filled by the even-odd rule with its edge (as by cv::fillPoly) it reproduces the mask, with two
/// exceptions. Bridges one pixel wide join its parts and holes, each where they are nearest. The smallest
/// parts and holes are left out: those of fewer than 9 pixels, those of together at most 2 % of the mask, and
/// all but the 200 largest. A mask has at least its largest part. Empty if the mask is empty or has no extent
/// of three pixels.
[[nodiscard]] std::vector<cv::Point> outlineOf(const cv::Mat& mask);

}  // namespace scantrove
