#pragma once
#include <opencv2/core/mat.hpp>

#include "core/fusion/depth_view.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Where a frame contradicts the map: the pixels of `view`, rendered from where `now` was taken, whose
/// surface has something before it, or is seen through. CV_8UC1, 255 there, else 0. A reading on the surface
/// in the next pixel is enough to agree; without a reading nothing is said. `depth_noise_m`: FusionParams.
[[nodiscard]] cv::Mat contradictedSurface(const DepthView& now, const RenderedView& view,
                                          float depth_noise_m);

}  // namespace scantrove
