#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/discovery/outline_step.h"
#include "core/discovery/region_census.h"

namespace scantrove {

inline constexpr int kMinContact = 4;  ///< least steps for two regions to touch

/// The outlines of an image's regions, by step kind and neighbour.
class RegionOutlines {
 public:
  /// Classifies every step between pixels of different regions, to the right and downwards, from both sides.
  explicit RegionOutlines(const DiscoveryInput& input);

  /// The steps of the set's outline, without those between its own regions.
  [[nodiscard]] OutlineSteps of(const RegionSet& regions) const;
  /// The same, by the region beyond; none: no region there.
  [[nodiscard]] std::map<RegionId, OutlineSteps> beyond(const RegionSet& regions) const;
  /// The steps from `a` to `b`.
  [[nodiscard]] OutlineSteps between(RegionId a, RegionId b) const;
  /// Neighbours of `region` in the image along at least `least_steps` known steps, touching or not, in rising
  /// order.
  [[nodiscard]] std::vector<RegionId> touchedBy(RegionId region, int least_steps) const;

 private:
  struct Beyond {
    RegionId region;
    OutlineSteps steps;
  };
  /// Visits the neighbours beyond the set's outline, once for each of its regions.
  template <class Visit>
  void forEachBeyond(const RegionSet& regions, const Visit& visit) const;

  std::unordered_map<RegionId, std::vector<Beyond>> outlines_;  // none: no region there
};

}  // namespace scantrove
