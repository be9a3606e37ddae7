#pragma once
#include <map>
#include <span>
#include <vector>

#include "core/discovery/candidate.h"

namespace scantrove {

/// The best look at each set of regions, once nothing more comes of a scan, and which of the sets are the
/// things that the scan has seen.
class BestLooks {
 public:
  struct Best {
    RegionSet regions;
    float wholeness = 0;  ///< Candidate::wholeness
    int frame_index = 0;
  };

  /// What one frame shows.
  void add(int frame_index, std::span<const Candidate> candidates);
  /// The sets of at least that wholeness, but those that share a region with a more likely one. Most likely
  /// first.
  [[nodiscard]] std::vector<Best> disjoint(float least_wholeness) const;
  /// It was seen, but as no part of anything of that wholeness.
  [[nodiscard]] bool isUnlikely(RegionId region, float least_wholeness) const;

 private:
  struct Look {
    float wholeness = 0;
    int frame_index = 0;
  };
  std::map<RegionSet, Look> best_;
};

}  // namespace scantrove
