#pragma once
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The visible sizes of regions over their last consecutive sightings. Holds only regions of the last frame,
/// and of each at most the `frames` newest sizes.
class SizeHistory {
 public:
  struct Sighting {
    RegionId region;
    float visible_area_m2 = 0;
  };

  /// Adds one frame's sightings; a region that is missing starts anew when it comes back.
  void add(std::span<const Sighting> sightings, int frames);

  /// True when the region was seen `frames` times in a row and its sizes differ by at most `tolerance` of the
  /// largest.
  [[nodiscard]] bool isPersistent(RegionId region, int frames, float tolerance) const;

  /// `into` keeps its own history; where it has none it takes that of `from`.
  void merge(RegionId into, RegionId from);

  [[nodiscard]] std::size_t regionCount() const { return areas_.size(); }

 private:
  std::unordered_map<RegionId, std::vector<float>> areas_;  // oldest first
};

}  // namespace scantrove
