#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>

#include "core/discovery/region_set.h"
#include "core/labeling/region_merger.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// The regions of a map, each divided as it would be if every border spoke less for joining. What stands in a
/// row, or lies on something like it, may have become one region; whether a part of it is a thing by itself
/// is for RegionJudge to say, which looks at both.
class FinerRegions {
 public:
  /// Regions that somebody knows (RegionTable::isKnown) or said something of stay whole, and those that
  /// `stays` says so of. `voxels`: by fragment number.
  FinerRegions(const RegionTable& table, const RegionMerger& merger, std::span<const int> voxels,
               const LabelingParams& params, const std::function<bool(RegionId)>& stays);

  [[nodiscard]] const RegionTable& table() const { return table_; }
  [[nodiscard]] bool areDivided() const { return !parts_.empty(); }
  /// One of `finer` is a part of a region.
  [[nodiscard]] bool holdsPart(const RegionSet& finer) const;
  /// All that some undivided regions are made of.
  [[nodiscard]] RegionSet partsOf(const RegionSet& regions) const;

  /// Makes regions of the `wholes` (of table(), no two with a part in common): what is left of the regions
  /// that they were parts of stays one region each. The merger keeps the parts apart from then on.
  void apply(std::span<const RegionSet> wholes, RegionTable& table, RegionMerger& merger,
             std::span<const int> voxels, RegionEvents& events) const;
  /// What is in `finer`, in regions of `table` after apply(). None: a part of a region.
  [[nodiscard]] std::optional<RegionSet> regionsOf(const RegionSet& finer, const RegionTable& table) const;

 private:
  [[nodiscard]] std::vector<FragmentId> fragmentsOf(const RegionSet& finer) const;

  RegionTable table_;
  std::map<RegionId, RegionSet> parts_;  // of the regions that are divided
};

}  // namespace scantrove
