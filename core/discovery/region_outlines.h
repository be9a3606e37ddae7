#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/region_census.h"

namespace scantrove {

/// Steps from pixels of a region across its outline, by what lies beyond.
struct OutlineSteps {
  int open = 0;    ///< the surface beyond lies deeper or lower: here the thing ends
  int folded = 0;  ///< it touches and rises: the thing stands on it or leans against it
  int smooth = 0;  ///< it goes on as it was: a cut across a surface
  int ridged = 0;  ///< it bends away: another side of the same thing, as a rule
  int hidden = 0;  ///< it is nearer and hides what the thing is like there
  int cut = 0;     ///< the image ends
  int unseen = 0;  ///< nothing is known there: says neither

  void operator+=(const OutlineSteps& other);
  [[nodiscard]] int touching() const { return folded + smooth + ridged; }
  [[nodiscard]] int known() const { return open + touching() + hidden + cut; }
  /// Part of what is known, and neither hidden nor cut off, that is the thing's own edge: open, or a fold. 0
  /// where that is nothing.
  [[nodiscard]] float own() const;
  /// Part of what is known that lies behind something nearer.
  [[nodiscard]] float hiddenPart() const;
};

inline constexpr int kLeastContact = 4;  ///< steps along which two regions touch, of one thing or not

/// How the regions of an image end, and against what.
class RegionOutlines {
 public:
  /// Looks at every step between pixels of different regions, to the right and downwards, from both sides.
  RegionOutlines(const DiscoveryInput& input, const DiscoveryParams& params);

  /// Of the set's outline: steps from one of its regions to another are inside.
  [[nodiscard]] OutlineSteps of(const RegionSet& regions) const;
  /// The same, by what lies beyond; none: no region there.
  [[nodiscard]] std::map<RegionId, OutlineSteps> beyond(const RegionSet& regions) const;
  /// From `a` to `b`.
  [[nodiscard]] OutlineSteps between(RegionId a, RegionId b) const;
  /// Regions that `region` meets along at least `least_steps` steps of which something is known, whether it
  /// touches them there or not, rising.
  [[nodiscard]] std::vector<RegionId> metBy(RegionId region, int least_steps) const;

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
