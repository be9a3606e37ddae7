#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>

#include "core/discovery/region_set.h"
#include "core/labeling/region_merger.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// The regions of a map, each split as if every border had less evidence for joining. Similar things in a
/// row, or on a similar surface, may have become one region. RegionJudge rates both and decides whether a
/// part is a separate thing.
class FinerRegions {
 public:
  /// Regions stay undivided if they are known (RegionTable::isKnown), were edited, or `stays` says so.
  /// `voxels`: by fragment number.
  FinerRegions(const RegionTable& table, const RegionMerger& merger, std::span<const int> voxels,
               const LabelingParams& params, const std::function<bool(RegionId)>& stays);

  [[nodiscard]] const RegionTable& table() const { return table_; }
  [[nodiscard]] bool areDivided() const { return !parts_.empty(); }
  /// Whether one of `finer` is a part of a region.
  [[nodiscard]] bool holdsPart(const RegionSet& finer) const;
  /// All parts of some undivided regions.
  [[nodiscard]] RegionSet partsOf(const RegionSet& regions) const;

  /// Makes regions of the `complete` sets (of table(), without common parts). The remainder of each affected
  /// region stays one region. The merger keeps the parts separate from then on.
  void apply(std::span<const RegionSet> complete, RegionTable& table, RegionMerger& merger,
             std::span<const int> voxels, RegionEvents& events) const;
  /// The regions of `table` after apply() that make up `finer`. None: `finer` is only a part of a region.
  [[nodiscard]] std::optional<RegionSet> regionsOf(const RegionSet& finer, const RegionTable& table) const;

 private:
  [[nodiscard]] std::vector<FragmentId> fragmentsOf(const RegionSet& finer) const;

  RegionTable table_;
  std::map<RegionId, RegionSet> parts_;  // of the divided regions
};

}  // namespace scantrove
