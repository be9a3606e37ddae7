#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Makes one mask of a moving thing from its traces. `intruding`: readings where there was free space;
/// `standings`: of all readings (Standing); `z_m`: the readings, metres. A smooth patch of readings that the
/// map does not know moves as a whole when a good part of it intrudes: somebody's middle stands where it
/// stood a moment ago. Specks are noise and go; what stays grows by a pixel, for at edges readings mix.
/// All images alike in size; returns CV_8UC1, 255 or 0.
[[nodiscard]] cv::Mat movingPixels(const cv::Mat& intruding, const cv::Mat& consistencies,
                                   const cv::Mat& z_m);

/// Where known surface was seen through, without specks and edges: CV_8UC1, 255 or 0.
[[nodiscard]] cv::Mat vacatedPixels(const cv::Mat& consistencies);

}  // namespace scantrove
