#pragma once
#include "core/discovery/outline_step.h"
#include "core/discovery/set_pixels.h"

namespace scantrove {

/// How clearly the outline of some regions bounds them: 1 = the surface ends or folds there, 0 = surface and
/// colour continue. A part of an object, or one of several objects in a row, has an unbounded side.
struct OutlineBounds {
  float mean = 0.5F;
  float least_side = 0.5F;  ///< the least bounded of the four sides along and across the longer axis
};

/// Hidden, cut-off and unseen steps do not count; unknown parts of a side count as 0.5. `pixels` and `axes`
/// belong to `input`.
[[nodiscard]] OutlineBounds outlineBoundsOf(const SetPixels& pixels, const SetAxes& axes,
                                            const DiscoveryInput& input);

}  // namespace scantrove
