#pragma once
#include <Eigen/Geometry>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The final map as a camera saw it.
struct AlignedView {
  ViewOfMap map;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  ///< that `map` was rendered from
};

/// Renders the map from the pose at which it fits the camera's depth best, near `T_world_camera`
/// (alignToMap). `measured_m`: CV_32FC1, h x w of K, 0 = no reading; empty: the pose stays. Error: the map.
[[nodiscard]] Result<AlignedView> renderAligned(LabeledScan& scan, const Intrinsics& K,
                                                const Eigen::Isometry3d& T_world_camera,
                                                const cv::Mat& measured_m);

/// The pose of a key frame's colour camera (without colour: of its depth camera) at which the map fits its
/// depth best. `depth`: its depth image, CV_16UC1; with none, or one of another size, the pose stays. Error:
/// the map.
[[nodiscard]] Result<Eigen::Isometry3d> alignedPoseOf(LabeledScan& scan, const KeyFrameInfo& frame,
                                                      const cv::Mat& depth);

}  // namespace scantrove
