#pragma once
#include "core/discovery/outline_step.h"
#include "core/discovery/set_pixels.h"

namespace scantrove {

/// How clearly some regions end where they do: 1 = the surface ends there or folds, 0 = it goes on and its
/// colour, too. Of a piece of a thing, or of one of several in a row, some side is not bounded.
struct OutlineBounds {
  float mean = 0.5F;
  float least_side = 0.5F;  ///< of the four sides, along and across the longer axis, the one bounded least
};

/// What is hidden, cut off or unseen says nothing; what is not known of a side is taken for half.
/// `pixels` and `axes` are of `input`.
[[nodiscard]] OutlineBounds outlineBoundsOf(const SetPixels& pixels, const SetAxes& axes,
                                            const DiscoveryInput& input);

}  // namespace scantrove
