#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Thesis eq. 4.1 over annotated pixels (`counted`, 255 or 0): mean of |d_truth(p) - d_segmentation(p)|, d =
/// distance in pixels to the nearest boundary pixel (see label_grid.h). 0 without annotated pixels.
[[nodiscard]] double boundaryError(const cv::Mat1b& segmentation_boundary, const cv::Mat1b& truth_boundary,
                                   const cv::Mat1b& counted);

/// Share of the pixels of `boundary` within `tolerance_px` of a pixel of `reference`; 1 when `boundary` is
/// empty.
[[nodiscard]] double boundaryShareNear(const cv::Mat1b& boundary, const cv::Mat1b& reference,
                                       double tolerance_px);

}  // namespace scantrove
