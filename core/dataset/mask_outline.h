#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace scantrove {

/// One closed polygon through the outermost pixels of a mask (CV_8UC1), as programs that know one polygon an
/// object want it. Filled by the even-odd rule with its edge (cv::fillPoly does) it gives the mask again, but
/// for: its several parts, and its holes, are joined by bridges one pixel wide; parts and holes of less than
/// 2 % of it, or of fewer than 9 pixels, are left out. Empty if the mask is, or has no three pixels' extent.
[[nodiscard]] std::vector<cv::Point> outlineOf(const cv::Mat& mask);

}  // namespace scantrove
