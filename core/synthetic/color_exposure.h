#pragma once
#include <span>
#include <vector>

#include "core/synthetic/renderer.h"

namespace scantrove::synthetic {

/// Rigid motions from the image's moment to a later one, in the camera's frame: one for each part of the
/// scene, and one more, the last, for pixels without a surface.
using PartMotions = std::vector<Eigen::Isometry3f>;

/// The colour image of `now` as exposed at later moments: the mean over `moments`, CV_8UC3. Each surface
/// point moves with its part, and nearer points hide farther ones. Newly visible surfaces look like their
/// farther neighbour, so moments should differ by few pixels.
[[nodiscard]] cv::Mat exposeColor(const RenderedFrame& now, const Intrinsics& K,
                                  std::span<const PartMotions> moments);

}  // namespace scantrove::synthetic
