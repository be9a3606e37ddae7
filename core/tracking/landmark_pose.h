#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/tracking/color_view.h"
#include "core/tracking/landmark_term.h"

namespace scantrove {

/// A depth camera's pose as its colour image tells it.
struct LandmarkPose {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  SeenLandmarks seen;  ///< those that were found again where this pose has them
};

/// Where the camera of `view` stands by the landmarks that it shows: mutual nearest descriptors (near where
/// they are expected from `about`, the depth camera's pose, if it is given), P3P in RANSAC (Lepetit,
/// Moreno-Noguer and Fua 2009; OpenCV), refined over the inliers. None: too few were found again. The same
/// input gives the same pose. Any thread.
[[nodiscard]] std::optional<LandmarkPose> locate(const ColorView& view, const Landmarks& landmarks,
                                                 const std::optional<Eigen::Isometry3d>& about = {});

}  // namespace scantrove
