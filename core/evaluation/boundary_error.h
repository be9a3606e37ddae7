#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Thesis eq. 4.1: sum over pixels of |d_truth(p) - d_segmentation(p)| / (w h), d = distance in pixels to the
/// nearest boundary pixel (see label_grid.h).
[[nodiscard]] double boundaryError(const cv::Mat1b& segmentation_boundary, const cv::Mat1b& truth_boundary);

/// Share of the pixels of `boundary` that lie within `tolerance_px` of one of `reference`; 1 when `boundary`
/// is empty.
[[nodiscard]] double boundaryShareNear(const cv::Mat1b& boundary, const cv::Mat1b& reference,
                                       double tolerance_px);

}  // namespace scantrove
