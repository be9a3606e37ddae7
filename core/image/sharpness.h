#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Sharpness does not depend on contrast: the mean squared difference of neighbouring pixels, relative to
/// that of pixels 8 apart. A step has 1/8, one that is blurred over 5 pixels about 1/30. The smaller value of
/// both image directions counts, because motion blurs one. 0: unknown, for lack of contrast.

/// Sharpness of the squares of `side_px` pixels in `color` (CV_8UC3): CV_32FC1, one element for each complete
/// square. A tenth of the squares is expected to be uniform: their differences count as noise and are
/// subtracted.
[[nodiscard]] cv::Mat sharpnessOfSquares(const cv::Mat& color, int side_px);

/// Sharpness of a whole image (CV_8UC3), such as a crop, with its noise.
[[nodiscard]] float sharpnessOf(const cv::Mat& color);

}  // namespace scantrove
