#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/discovery/outline_step.h"
#include "core/discovery/region_census.h"

namespace scantrove {

inline constexpr int kMinContact = 4;  ///< steps along which two regions touch, of one thing or not

/// How the regions of an image end, and against what.
class RegionOutlines {
 public:
  /// Looks at every step between pixels of different regions, to the right and downwards, from both sides.
  explicit RegionOutlines(const DiscoveryInput& input);

  /// Of the set's outline: steps from one of its regions to another are inside.
  [[nodiscard]] OutlineSteps of(const RegionSet& regions) const;
  /// The same, by what lies beyond; none: no region there.
  [[nodiscard]] std::map<RegionId, OutlineSteps> beyond(const RegionSet& regions) const;
  /// From `a` to `b`.
  [[nodiscard]] OutlineSteps between(RegionId a, RegionId b) const;
  /// Regions that `region` meets along at least `least_steps` steps of which something is known, whether it
  /// touches them there or not, rising.
  [[nodiscard]] std::vector<RegionId> touchedBy(RegionId region, int least_steps) const;

 private:
  struct Beyond {
    RegionId region;
    OutlineSteps steps;
  };
  /// What lies beyond the set's outline, once for each of its regions.
  template <class Visit>
  void forEachBeyond(const RegionSet& regions, const Visit& visit) const;

  std::unordered_map<RegionId, std::vector<Beyond>> outlines_;  // none: no region there
};

}  // namespace scantrove
