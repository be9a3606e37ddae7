#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// A colour camera of its own beside the depth camera, fixed to it.
struct ColorCamera {
  Intrinsics K;  ///< of the colour images
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
};

/// How the colour images of a recording lie over its depth images, before the images' sizes are known.
struct ColorRegistration {
  /// What made the colour images; none: they are registered, that is they show what the depth images show,
  /// scaled. K for images of K.width x K.height; both 0: for the recording's, whatever their size.
  std::optional<ColorCamera> camera;
};

}  // namespace scantrove
