#pragma once
#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/editing/operation_log.h"
#include "core/editing/region_notes.h"
#include "core/labeling/region_table.h"
#include "core/refinement/surface_cells.h"
#include "core/session/region_label.h"

namespace scantrove {

/// Finds new supports that continue, in its plane, a surface that a person marked as background: more of the
/// same table or floor. One thread.
class ContinuedBackground {
 public:
  struct Regions {
    const RegionTable& table;
    const RegionNotes& notes;
    const OperationLog& log;
    const std::map<RegionId, RegionLabel>& labels;
  };
  /// Only regions above `last_known` are new. A region that a person ever edited is left as it is.
  ContinuedBackground(const Regions& regions, RegionId last_known);

  /// Whether there are marked regions and new supports; else the map need not be read.
  [[nodiscard]] bool mayFind() const { return !marked_.empty() && !supports_.empty(); }
  /// Adds a point of a region's surface (world, m) with its unit normal; 0 if unknown.
  void add(RegionId region, const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal_world);
  /// By rising number.
  [[nodiscard]] std::vector<RegionId> find() const;

 private:
  std::map<RegionId, SurfaceCells> marked_, supports_;
};

}  // namespace scantrove
