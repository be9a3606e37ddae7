#pragma once
#include "core/discovery/region_outlines.h"

namespace scantrove {

/// How likely some regions are one object with the regions that they touch in an image.
struct OutwardOdds {
  static constexpr float kMin = -8;  ///< without contact or evidence

  float most = kMin;      ///< largest DiscoveryInput::joining_odds of a contact
  float joined_part = 0;  ///< expected part of the known outline that lies inside a larger object
};

/// `outlines` belong to `input`.
[[nodiscard]] OutwardOdds outwardOddsOf(const RegionSet& regions, const RegionOutlines& outlines,
                                        const DiscoveryInput& input);

}  // namespace scantrove
