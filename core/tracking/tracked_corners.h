#pragma once
#include "core/tracking/color_view.h"
#include "core/tracking/landmark_term.h"

namespace scantrove {

/// Finds corners of one grey image in the next one by pyramidal optical flow (Lucas and Kanade; OpenCV). It
/// is accurate to a fraction of a pixel and works with almost no texture, for motions of a few degrees.
/// `surface`: the map's in `last`. `T_world_color`: approximate pose of the colour camera in `now`. Leaves
/// out corners that do not return when followed back from `now`. Any thread.
[[nodiscard]] SeenLandmarks trackCorners(const GrayView& last, const SurfaceInView& surface,
                                         const GrayView& now, const Eigen::Isometry3d& T_world_color);

}  // namespace scantrove
