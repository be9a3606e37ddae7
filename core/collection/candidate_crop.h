#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/capture/rgbd_frame.h"
#include "core/catalogue/object_record.h"
#include "core/discovery/candidate.h"
#include "core/fusion/color_projection.h"

namespace scantrove {

/// Unit vector from the candidate to the camera, world.
[[nodiscard]] Eigen::Vector3f directionOf(const Candidate& candidate,
                                          const Eigen::Isometry3d& T_world_camera);

/// The box of a candidate in fractions of the colour image's width and height; it may reach beyond the
/// image.
[[nodiscard]] cv::Rect2f boxInColor(const SurfaceInColor& in_color, const Candidate& candidate);

/// The view of a candidate in one frame (thesis 5.1.1): colour and mask at the colour image's resolution,
/// measured depth in millimetres registered to colour, pose, direction. Surface that is occluded from the
/// colour camera is left out. None: the colour image does not show the candidate. `in_color` belongs to the
/// frame, at the candidate's resolution.
[[nodiscard]] std::optional<ObjectView> cropView(const RgbdFrame& frame,
                                                 const Eigen::Isometry3d& T_world_camera,
                                                 const SurfaceInColor& in_color, const Candidate& candidate);

}  // namespace scantrove
