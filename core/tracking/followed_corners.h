#pragma once
#include "core/tracking/color_view.h"
#include "core/tracking/landmark_term.h"

namespace scantrove {

/// Corners of one grey image found again in the next one by optical flow (Lucas and Kanade, in pyramids;
/// OpenCV): to a fraction of a pixel, and even where there is next to no texture; for motions of a few
/// degrees. `surface`: of the map in `last`. `T_world_color`: a guess at where `now` was taken from. Corners
/// that are not found back again from `now` are left out. Any thread.
[[nodiscard]] SeenLandmarks followCorners(const GrayView& last, const SurfaceInView& surface,
                                          const GrayView& now, const Eigen::Isometry3d& T_world_color);

}  // namespace scantrove
