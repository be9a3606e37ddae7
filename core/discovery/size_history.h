#pragma once
#include <map>
#include <span>
#include <vector>

#include "core/discovery/region_set.h"

namespace scantrove {

/// The visible sizes of sets of regions over consecutive frames. Holds only sets of the last frame, with at
/// most the `frames` newest sizes each.
class SizeHistory {
 public:
  struct Sighting {
    RegionSet regions;
    float visible_area_m2 = 0;
  };

  /// Adds one frame's sightings; drops the history of sets that are missing.
  void add(std::span<const Sighting> sightings, int frames);

  /// True if the set was seen in `frames` consecutive frames and its sizes differ by at most `tolerance` of
  /// the largest.
  [[nodiscard]] bool isPersistent(const RegionSet& regions, int frames, float tolerance) const;

  /// `from` is now part of `into`. If two sets become equal, the existing one keeps its history.
  void joinRegions(RegionId into, RegionId from);

  [[nodiscard]] std::size_t setCount() const { return areas_.size(); }

 private:
  std::map<RegionSet, std::vector<float>> areas_;  // oldest first
};

}  // namespace scantrove
