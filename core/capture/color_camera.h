#pragma once

namespace scantrove {

/// A colour camera beside the depth camera, looking the same way.
struct ColorCamera {
  float fx = 0, fy = 0, cx = 0,
        cy = 0;          ///< of the colour image, pixels; all 0: the images are registered already
  float offset_x_m = 0;  ///< x of a point in the colour camera's frame less its x in the depth camera's

  bool operator==(const ColorCamera&) const = default;
};

}  // namespace scantrove
