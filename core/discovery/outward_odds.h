#pragma once
#include "core/discovery/region_outlines.h"

namespace scantrove {

/// How near some regions are to being one thing with what they touch in an image.
struct OutwardOdds {
  static constexpr float kMin = -8;  ///< of what touches nothing, or was never seen as one

  float most = kMin;      ///< DiscoveryInput::joining_odds of the contact that comes nearest
  float joined_part = 0;  ///< expected part of the known outline that lies inside of something larger
};

/// `outlines` are those of `input`.
[[nodiscard]] OutwardOdds outwardOddsOf(const RegionSet& regions, const RegionOutlines& outlines,
                                        const DiscoveryInput& input);

}  // namespace scantrove
