#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/editing/editable_map.h"
#include "core/editing/operation_log.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Table, borders and voxels of regions, changed together. The thread of the map; may throw cl::Error.
class EditableRegions {
 public:
  using Fragments = std::vector<FragmentId>;

  /// All outlive this.
  EditableRegions(RegionTable& table, RegionMerger& merger, EditableMap& map, OperationLog& log)
      : table_(table), merger_(merger), map_(map), log_(log) {}

  struct Division {
    std::vector<Fragments> parts;                            ///< fragments of each part that has any
    std::vector<std::pair<FragmentId, FragmentId>> divided;  ///< (new fragment, the one that it was cut from)
  };
  /// Splits fragments of one region that lie in several of `parts` parts. `part`: the part of each voxel of
  /// the graph. Fragments without such voxels, and what fragments have elsewhere, belong to the first part.
  /// The region keeps all fragments.
  [[nodiscard]] Division divideVoxels(RegionId region, const SurfaceGraph& graph,
                                      std::span<const std::uint32_t> part, std::size_t parts);

  /// Cannot-links between the largest fragments of both, and between all that touch.
  void keepApart(std::span<const FragmentId> one, std::span<const FragmentId> other, OperationEffect& effect);
  void constrain(FragmentId a, FragmentId b, LinkConstraint constraint, OperationEffect& effect);

  [[nodiscard]] FragmentId largestOf(std::span<const FragmentId> fragments) const;
  [[nodiscard]] int voxelsOf(FragmentId fragment) const;

  [[nodiscard]] RegionTable& table() const { return table_; }
  [[nodiscard]] EditableMap& map() const { return map_; }

 private:
  RegionTable& table_;
  RegionMerger& merger_;
  EditableMap& map_;
  OperationLog& log_;
};

}  // namespace scantrove
