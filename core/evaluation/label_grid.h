#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Converts a label image for the metrics: h x w, CV_32SC1 (or CV_16UC1, CV_8UC1, widened). Checks the type.
[[nodiscard]] cv::Mat1i toLabelGrid(const cv::Mat& labels);

/// Boundary pixels, h x w, 255 or 0: pixels whose right or lower neighbour has another label. Boundaries are
/// one pixel wide, on the left (upper) side of the change. Unlabelled (0) counts as a label.
[[nodiscard]] cv::Mat1b boundaryPixels(const cv::Mat1i& labels);

/// Exact Euclidean distance in pixels of each pixel to the nearest boundary pixel, h x w. Without any
/// boundary every distance is the image's diagonal, an upper bound.
[[nodiscard]] cv::Mat1f distanceToBoundary(const cv::Mat1b& boundary);

}  // namespace scantrove
