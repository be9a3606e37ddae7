#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/discovery/candidate.h"

namespace scantrove {

/// Sets of regions with their ratings from several observations at the end of a scan, and the selection of
/// complete objects. One observation may mislead, so the best eight are averaged with a neutral one. Others
/// may be poor (distant, blurred) for a clear object. Large sets are rated lower: there are many more sets
/// of pieces of furniture than large things, and the best of many is selected.
class RatedSets {
 public:
  struct Rated {
    RegionSet regions;
    /// Sum of the best eight Candidate::objectness, divided by their number plus one; reduced for large
    /// sets.
    float objectness = 0;
    int frame_index = 0;  ///< of the best observation; it shows the set entirely if any does
  };

  /// Adds the candidates of one frame.
  void add(int frame_index, std::span<const Candidate> candidates);
  /// The sets of at least that objectness, most likely first, without those that share a region with a more
  /// likely one.
  [[nodiscard]] std::vector<Rated> disjoint(float least_objectness) const;
  /// The objectness of each observed region: of the set of `complete` that holds it, else of the region
  /// alone.
  [[nodiscard]] std::map<RegionId, float> ofRegions(std::span<const Rated> complete) const;
  using Rename = std::function<std::optional<RegionSet>(const RegionSet&)>;
  /// Replaces each set by the result of `rename`; none: the set is dropped. Results must differ.
  void rename(const Rename& rename);
  /// The region was observed, but in no set of that objectness.
  [[nodiscard]] bool isUnlikely(RegionId region, float least_objectness) const;

 private:
  struct Observation {
    bool is_cut_off = false;
    float objectness = 0;
    int frame_index = 0;
    [[nodiscard]] bool isBetterThan(const Observation& other) const;
  };
  struct Observations {
    std::vector<float> best;  ///< Candidate::objectness, descending; at most eight
    float longest_m = 0;      ///< the longest side in Candidate::size_m
    std::optional<Observation> to_show;
    [[nodiscard]] float together() const;
  };
  std::map<RegionSet, Observations> observations_;
};

}  // namespace scantrove
