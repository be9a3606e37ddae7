#pragma once
#include <vector>

#include "core/discovery/region_outlines.h"

namespace scantrove {

/// Regions that may be one thing, all their image parts together. `extent.region` is the first of them.
struct RegionHypothesis {
  RegionSet regions;
  RegionExtent extent;
  float visible_area_m2 = 0;
  float odds = 0;  ///< of a set: the least log-odds of the contacts that hold it together
  bool is_inconsistent =
      false;  ///< it has the inside of something without the outside, or the outside without it
};

/// Each of the regions by itself, and the sets of up to four of them that touch one another and are near to
/// being joined (thesis ch. 6): `input.joining_odds` of each contact above -kNearOdds. A hollow
/// (isNotHollow) need not touch what it is the inside of: it meets that over the rim, which hides some of it.
/// By their regions; at most kMaxSets sets, those of fewest regions first.
[[nodiscard]] std::vector<RegionHypothesis> proposeHypotheses(std::span<const RegionExtent> regions,
                                                              const RegionOutlines& outlines,
                                                              const DiscoveryInput& input,
                                                              const DiscoveryParams& params);

inline constexpr float kNearOdds = 3;          ///< log-odds against: one to twenty
inline constexpr std::size_t kMaxRegions = 4;  ///< of a set
inline constexpr std::size_t kMaxSets = 96;    ///< bounds the cost of a frame

}  // namespace scantrove
