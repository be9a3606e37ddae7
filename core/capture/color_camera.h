#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// A separate colour camera, fixed to the depth camera.
struct ColorCamera {
  Intrinsics K;  ///< of the colour images
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
};

/// Registration of a recording's colour images to its depth images, before the image sizes are known.
struct ColorRegistration {
  /// The separate colour camera; none: colour is registered to depth and scaled. K is for images of K.width x
  /// K.height; both 0: for the recording's images of any size.
  std::optional<ColorCamera> camera;
};

}  // namespace scantrove
