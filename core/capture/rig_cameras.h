#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/capture/camera_intrinsics.h"

namespace scantrove {

/// Two cameras on one rig as ScanNet, BundleFusion and 3RScan describe them: 4x4 matrices each.
struct RigCamera {
  int width = 0, height = 0;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();    ///< fx, fy, cx, cy in the upper left 3x3
  Eigen::Matrix4d T_rig_camera = Eigen::Matrix4d::Identity();  ///< no rigid motion: taken as identity

  [[nodiscard]] Intrinsics intrinsics() const;
};

/// The depth camera with the colour camera beside it. `color`: none = depth only. Equal cameras at one place
/// count as registered.
[[nodiscard]] CameraModel rigModel(const RigCamera& depth, const std::optional<RigCamera>& color);

}  // namespace scantrove
