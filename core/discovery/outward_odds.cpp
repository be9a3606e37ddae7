#include "core/discovery/outward_odds.h"

#include <algorithm>
#include <cmath>

namespace scantrove {

OutwardOdds outwardOddsOf(const RegionSet& regions, const RegionOutlines& outlines,
                          const DiscoveryInput& input) {
  OutwardOdds outward;
  if (!input.joining_odds) return outward;
  const std::map<RegionId, OutlineSteps> all = outlines.beyond(regions);
  int known = 0;
  for (const auto& [beyond, steps] : all) known += steps.known();
  for (const auto& [beyond, steps] : all) {
    if (!beyond || steps.touching() < kMinContact) continue;
    float odds = OutwardOdds::kMin;
    for (const RegionId region : regions) {
      if (outlines.between(region, beyond).touching() >= kMinContact)
        odds = std::max(odds, input.joining_odds(region, beyond));
    }
    outward.most = std::max(outward.most, odds);
    outward.joined_part +=
        static_cast<float>(steps.touching()) / static_cast<float>(known) / (1 + std::exp(-odds));
  }
  return outward;
}

}  // namespace scantrove
