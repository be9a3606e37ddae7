#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// Finds the error of a key frame's pose against the final map: the camera was tracked before the map was
/// complete, and a recording's depth is biased by its distance.
///
/// `measured_m` and `map_m`: CV_32FC1, h x w of K, metres along the axis, 0 = nothing: what the camera
/// measured, and the map rendered from the key frame's pose. Result: T_rendered_camera, the camera in the
/// frame of the rendered view. None: the pose is as good as any, or too little of the map is seen.
///
/// Point-to-plane ICP with projective correspondences (Rusinkiewicz, Levoy 2001). What only one of the two
/// images shows is left out. Directions along which the surface may slide stay as they are. Any thread.
[[nodiscard]] std::optional<Eigen::Isometry3d> alignToMap(const cv::Mat& measured_m, const cv::Mat& map_m,
                                                          const Intrinsics& K);

}  // namespace scantrove
