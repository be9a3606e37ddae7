#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// A label image as the metrics take it: h x w, CV_32SC1 (or CV_16UC1, CV_8UC1, widened). Checks the type.
[[nodiscard]] cv::Mat1i toLabelGrid(const cv::Mat& labels);

/// Boundary pixels, h x w, 255 or 0: a pixel is on the boundary when its right or its lower neighbour has
/// another label. So a boundary is one pixel wide and lies on the left (upper) side of the change. Unlabelled
/// (0) is a label like others.
[[nodiscard]] cv::Mat1b boundaryPixels(const cv::Mat1i& labels);

/// Exact Euclidean distance in pixels of each pixel to the nearest boundary pixel, h x w. An image without
/// any boundary gives its diagonal everywhere: the farthest that a boundary could be.
[[nodiscard]] cv::Mat1f distanceToBoundary(const cv::Mat1b& boundary);

}  // namespace scantrove
