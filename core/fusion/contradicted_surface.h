#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>

#include "core/capture/intrinsics.h"
#include "core/fusion/depth_view.h"

namespace scantrove {

/// Where a frame says otherwise than a surface: the pixels of `vertices_world` (row by row, by `K`, seen from
/// where `now` was taken; w = 0: no surface) in which something stands before it, or that are seen through.
/// CV_8UC1, 255 there, else 0. A reading on the surface in the next pixel is enough to agree; without a
/// reading nothing is said. `depth_noise_m`: FusionParams.
[[nodiscard]] cv::Mat contradictedSurface(const DepthView& now, const Intrinsics& K,
                                          std::span<const Eigen::Vector4f> vertices_world,
                                          float depth_noise_m);

}  // namespace scantrove
