#pragma once
#include <Eigen/Geometry>

#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalog/object_record.h"
#include "core/discovery/candidate.h"

namespace scantrove {

/// From the candidate to the camera, unit, world.
[[nodiscard]] Eigen::Vector3f directionOf(const Candidate& candidate,
                                          const Eigen::Isometry3d& T_world_camera);

/// The view of a candidate in one frame: colour of full resolution, mask, depth in millimetres, pose,
/// direction (thesis 5.1.1). The crop is the candidate's box, brought from the working to the colour image's
/// resolution.
[[nodiscard]] ObjectView cutView(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                 const Intrinsics& working_K, const Candidate& candidate);

}  // namespace scantrove
