#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/capture/rgbd_frame.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/depth_view.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// A frame's images beside the rendered view of the map; all but `depth` have the pixels of that view.
struct FrameObservation {
  SurfaceInColor in_color;
  std::vector<Eigen::Vector3f> color_lab;  ///< CIE L*a*b* of the surface, slightly blurred; empty: no colour
  DepthView depth;                         ///< readings at their own resolution
  cv::Mat contradicted;                    ///< CV_8UC1, nonzero: see contradictedSurface
};

/// `view`: the map rendered from the frame's pose; `in_color`: of its pixels. `depth_noise_m`:
/// FusionParams. Any thread.
[[nodiscard]] FrameObservation observe(const RgbdFrame& frame, const RenderedView& view,
                                       SurfaceInColor in_color, float depth_noise_m);

}  // namespace scantrove
