#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Thesis eq. 4.1 over the pixels where something is annotated (`counted`, 255 or 0): the mean there of
/// |d_truth(p) - d_segmentation(p)|, d = distance in pixels to the nearest boundary pixel (see label_grid.h).
/// 0 where nothing is.
[[nodiscard]] double boundaryError(const cv::Mat1b& segmentation_boundary, const cv::Mat1b& truth_boundary,
                                   const cv::Mat1b& counted);

/// Share of the pixels of `boundary` that lie within `tolerance_px` of one of `reference`; 1 when `boundary`
/// is empty.
[[nodiscard]] double boundaryShareNear(const cv::Mat1b& boundary, const cv::Mat1b& reference,
                                       double tolerance_px);

}  // namespace scantrove
