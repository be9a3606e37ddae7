#pragma once
#include <opencv2/core/mat.hpp>

#include "core/fusion/depth_view.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Pixels where a frame contradicts the map: readings lie in front of the surface of `view` or behind it.
/// `view` is rendered from the pose of `now`. CV_8UC1, 255 = contradicted, else 0. A reading on the surface
/// in an adjacent pixel counts as agreement; pixels without reading never contradict. `depth_noise_m`:
/// FusionParams.
[[nodiscard]] cv::Mat contradictedSurface(const DepthView& now, const RenderedView& view,
                                          float depth_noise_m);

}  // namespace scantrove
