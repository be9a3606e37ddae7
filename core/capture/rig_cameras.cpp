#include "core/capture/rig_cameras.h"

#include <cmath>

#include "core/capture/pose_files.h"

namespace scantrove {
namespace {

/// Images of equal cameras differ in scale alone.
bool isScaledCamera(const Intrinsics& depth, const Intrinsics& color) {
  constexpr float kAgree_px = 0.01F;
  if (depth.width * color.height != depth.height * color.width || depth.width == 0) return false;
  const Intrinsics scaled = depth.resizedTo(color.width, color.height);
  const auto agree = [](float a, float b) { return std::abs(a - b) <= kAgree_px; };
  return agree(scaled.fx, color.fx) && agree(scaled.fy, color.fy) && agree(scaled.cx, color.cx) &&
         agree(scaled.cy, color.cy);
}

}  // namespace

Intrinsics RigCamera::intrinsics() const {
  const auto at = [&](int row, int column) { return static_cast<float>(projection(row, column)); };
  return {at(0, 0), at(1, 1), at(0, 2), at(1, 2), width, height};
}

CameraModel rigModel(const RigCamera& depth, const std::optional<RigCamera>& color) {
  CameraModel model{depth.intrinsics(), std::nullopt};
  if (!color) return model;
  const auto placeOf = [](const RigCamera& camera) {
    return rigidMotion(camera.T_rig_camera).value_or(Eigen::Isometry3d::Identity());
  };
  const Eigen::Isometry3d T_color_depth = placeOf(*color).inverse() * placeOf(depth);
  const bool is_registered =
      T_color_depth.isApprox(Eigen::Isometry3d::Identity()) && isScaledCamera(model.K, color->intrinsics());
  model.color = is_registered ? ColorRegistration{}
                              : ColorRegistration{ColorCamera{color->intrinsics(), T_color_depth}};
  return model;
}

}  // namespace scantrove
