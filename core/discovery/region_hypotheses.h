#pragma once
#include <vector>

#include "core/discovery/region_outlines.h"

namespace scantrove {

/// Regions that may be one object, with all their parts in the image. `extent.region` is the first of them.
struct RegionHypothesis {
  RegionSet regions;
  RegionExtent extent;
  float visible_area_m2 = 0;
  float odds = 0;                ///< of a set: the least log-odds of the contacts that join it
  bool is_inconsistent = false;  ///< it has an object's inside without the outside, or the reverse
};

/// Each region alone, and sets of up to four touching regions that are close to joining (thesis ch. 6):
/// `input.joining_odds` of each contact is above -kNearOdds. A concave region (isConcave) may be the inside
/// of an object without touching its outside, because the rim occludes the contact. Ordered by regions; at
/// most kMaxSets sets, those with fewest regions first.
[[nodiscard]] std::vector<RegionHypothesis> proposeHypotheses(std::span<const RegionExtent> regions,
                                                              const RegionOutlines& outlines,
                                                              const DiscoveryInput& input,
                                                              const DiscoveryParams& params);

inline constexpr float kNearOdds = 3;          ///< log-odds against: one to twenty
inline constexpr std::size_t kMaxRegions = 4;  ///< of a set
inline constexpr std::size_t kMaxSets = 96;    ///< bounds the cost of a frame

}  // namespace scantrove
