#pragma once
#include <cstdint>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Raw label -> region. Voxels hold raw labels, which never change their number; joining two regions is one
/// entry here and reaches every voxel, seen or not. A region is named by its root label. One
/// thread.
class LabelTable {
 public:
  /// A raw label that no voxel holds yet: a region of its own.
  RegionId newLabel();

  /// Region of a raw label. 0 stays 0.
  [[nodiscard]] RegionId regionOf(std::uint32_t label) const;

  /// Joins the regions of two labels; `into` gives the name. False when they are one already.
  bool join(RegionId into, RegionId from);

  /// Region of every raw label, by raw label, [0] = 0. Valid until the next change.
  [[nodiscard]] const std::vector<std::uint32_t>& regionOfLabel() const;

 private:
  [[nodiscard]] std::uint32_t find(std::uint32_t label) const;

  mutable std::vector<std::uint32_t> parents_{0};  // path compression changes it, never its meaning
  mutable std::vector<std::uint32_t> flat_{0};
  mutable bool flat_is_current_ = true;
};

}  // namespace scantrove
