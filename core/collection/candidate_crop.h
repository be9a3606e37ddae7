#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/capture/rgbd_frame.h"
#include "core/catalogue/object_record.h"
#include "core/discovery/candidate.h"
#include "core/fusion/color_projection.h"

namespace scantrove {

/// From the candidate to the camera, unit, world.
[[nodiscard]] Eigen::Vector3f directionOf(const Candidate& candidate,
                                          const Eigen::Isometry3d& T_world_camera);

/// The box of a candidate in fractions of the colour image's width and height; may reach beyond it.
[[nodiscard]] cv::Rect2f boxInColor(const SurfaceInColor& in_color, const Candidate& candidate);

/// The view of a candidate in one frame: colour and mask at the colour image's own resolution, depth in
/// millimetres (as the depth camera measured it, laid over colour), pose, direction (thesis 5.1.1). What
/// something else hides from the colour camera is no part of it. None: the colour image does not show the
/// candidate at all. `in_color`: of the frame, for the image that the candidate was seen in.
[[nodiscard]] std::optional<ObjectView> cropView(const RgbdFrame& frame,
                                                 const Eigen::Isometry3d& T_world_camera,
                                                 const SurfaceInColor& in_color, const Candidate& candidate);

}  // namespace scantrove
