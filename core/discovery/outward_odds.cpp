#include "core/discovery/outward_odds.h"

#include <algorithm>
#include <cmath>

namespace scantrove {

OutwardOdds outwardOddsOf(const RegionSet& regions, const RegionOutlines& outlines,
                          const DiscoveryInput& input) {
  OutwardOdds outward;
  if (!input.joining_odds) return outward;
  const auto known = static_cast<float>(std::max(1, outlines.of(regions).known()));
  for (const auto& [beyond, steps] : outlines.beyond(regions)) {
    if (!beyond || steps.touching() < kLeastContact) continue;
    float odds = OutwardOdds::kLeast;
    for (const RegionId region : regions) {
      if (outlines.between(region, beyond).touching() >= kLeastContact)
        odds = std::max(odds, input.joining_odds(region, beyond));
    }
    outward.most = std::max(outward.most, odds);
    outward.joined_part += static_cast<float>(steps.touching()) / known / (1 + std::exp(-odds));
  }
  return outward;
}

}  // namespace scantrove
