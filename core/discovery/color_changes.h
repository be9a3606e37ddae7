#pragma once
#include "core/discovery/candidate_finder.h"
#include "core/discovery/set_pixels.h"

namespace scantrove {

/// The sharpest colour change across a straight line through some regions. Two objects in a row have one
/// where they meet, but a book has one, too, between cover and spine.
struct ColorChange {
  float contrast = 0;  ///< mean colorContrast() across the line
  float likeness = 1;  ///< of the colours on both sides of the line (ColorHistogram::intersection)
};
struct ColorChanges {
  ColorChange along;   ///< along their longer axis
  ColorChange across;  ///< across that axis
};

/// `pixels` and `axes` belong to `input`, which must have colour.
[[nodiscard]] ColorChanges colorChangesOf(const SetPixels& pixels, const SetAxes& axes,
                                          const DiscoveryInput& input);

}  // namespace scantrove
