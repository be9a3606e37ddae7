#pragma once
#include <map>
#include <span>
#include <vector>

#include "core/discovery/region_set.h"

namespace scantrove {

/// The visible sizes of sets of regions over their last consecutive sightings. Holds only sets of the last
/// frame, and of each at most the `frames` newest sizes.
class SizeHistory {
 public:
  struct Sighting {
    RegionSet regions;
    float visible_area_m2 = 0;
  };

  /// Adds one frame's sightings; a set that is missing starts anew when it comes back.
  void add(std::span<const Sighting> sightings, int frames);

  /// True when the set was seen `frames` times in a row and its sizes differ by at most `tolerance` of the
  /// largest.
  [[nodiscard]] bool isPersistent(const RegionSet& regions, int frames, float tolerance) const;

  /// `from` is now part of `into`: where that makes two sets one, the one that was there keeps its history.
  void follow(RegionId into, RegionId from);

  [[nodiscard]] std::size_t setCount() const { return areas_.size(); }

 private:
  std::map<RegionSet, std::vector<float>> areas_;  // oldest first
};

}  // namespace scantrove
