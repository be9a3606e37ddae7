#pragma once
#include "core/discovery/candidate_finder.h"
#include "core/discovery/set_pixels.h"

namespace scantrove {

/// The sharpest change of colour inside of some regions, on a line straight through them: where two things in
/// a row meet, and also where the cover of a book ends on its spine.
struct ColorChange {
  float contrast = 0;  ///< colorContrast() over the line, the mean along it
  float likeness = 1;  ///< of what lies to one side of it and to the other (ColorHistogram::intersection)
};
struct ColorChanges {
  ColorChange along;   ///< on the way along their longer axis
  ColorChange across;  ///< on the way across it
};

/// `pixels` and `axes` are of `input`, whose image has colour.
[[nodiscard]] ColorChanges colorChangesOf(const SetPixels& pixels, const SetAxes& axes,
                                          const DiscoveryInput& input);

}  // namespace scantrove
