#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/tracking/color_view.h"
#include "core/tracking/landmark_term.h"

namespace scantrove {

/// A depth camera's pose by its colour image.
struct LandmarkPose {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  SeenLandmarks seen;  ///< the landmarks that agree with this pose
};

/// Pose of the camera of `view` by the landmarks that it shows: mutual nearest descriptors, P3P in RANSAC
/// (Lepetit, Moreno-Noguer and Fua 2009; OpenCV), and refinement over the inliers. With `about`, an
/// approximate pose of the depth camera, matches only near the predicted pixels. None: too few landmarks
/// match. The same input gives the same pose. Any thread.
[[nodiscard]] std::optional<LandmarkPose> locate(const ColorView& view, const Landmarks& landmarks,
                                                 const std::optional<Eigen::Isometry3d>& about = {});

}  // namespace scantrove
