#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/discovery/candidate.h"

namespace scantrove {

/// Sets of regions as looks at them rated them, once nothing more comes of a scan, and which of the sets are
/// the things that the scan has seen. One look may mislead: the best eight count together, and as one more
/// that says nothing either way. Others may be poor ones (from afar, of a blurred image) of a clear thing.
/// What is large is less likely than its looks say: there are many more sets of pieces of furniture than
/// large things, and the best of many is kept.
class RatedSets {
 public:
  struct Rated {
    RegionSet regions;
    /// Sum of the best eight Candidate::objectness, by one more than these are; less for what is large.
    float objectness = 0;
    int frame_index = 0;  ///< of the best look: that shows them entirely, if one does
  };

  /// What one frame shows.
  void add(int frame_index, std::span<const Candidate> candidates);
  /// The sets of at least that objectness, but those that share a region with a more likely one. Most likely
  /// first.
  [[nodiscard]] std::vector<Rated> disjoint(float least_objectness) const;
  using Rename = std::function<std::optional<RegionSet>(const RegionSet&)>;
  /// Each set is called as `rename` says; none: it is forgotten. No two are called the same.
  void rename(const Rename& rename);
  /// It was seen, but as no part of anything of that objectness.
  [[nodiscard]] bool isUnlikely(RegionId region, float least_objectness) const;

 private:
  struct Look {
    bool is_cut_off = false;
    float objectness = 0;
    int frame_index = 0;
    [[nodiscard]] bool isBetterThan(const Look& other) const;
  };
  struct Observations {
    std::vector<float> best;  ///< Candidate::objectness, falling; at most eight
    float longest_m = 0;      ///< Candidate::size_m, its longest side
    std::optional<Look> to_show;
    [[nodiscard]] float together() const;
  };
  std::map<RegionSet, Observations> observations_;
};

}  // namespace scantrove
