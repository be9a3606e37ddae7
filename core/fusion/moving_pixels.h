#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// The mask of moving objects. `intruding`: readings in former free space; `consistencies`: DepthConsistency
/// of all readings; `z_m`: the readings, metres. A smooth patch of readings unknown to the map moves as a
/// whole if a sufficient part of it intrudes, because a person's middle often overlaps its previous place.
/// Small components are removed as noise; the rest is dilated by a pixel, because readings mix at edges. All
/// images have one size; returns CV_8UC1, 255 or 0.
[[nodiscard]] cv::Mat movingPixels(const cv::Mat& intruding, const cv::Mat& consistencies,
                                   const cv::Mat& z_m);

/// Pixels with readings behind known surface, without small components and edges: CV_8UC1, 255 or 0.
[[nodiscard]] cv::Mat vacatedPixels(const cv::Mat& consistencies);

}  // namespace scantrove
