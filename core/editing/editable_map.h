#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/editing/surface_graph.h"

namespace scantrove {

/// What operations need of the map that the regions are in. May throw cl::Error.
class EditableMap {
 public:
  virtual ~EditableMap() = default;

  [[nodiscard]] virtual float voxelSize() const = 0;
  /// How many voxels hold each fragment, by fragment number.
  [[nodiscard]] virtual std::span<const int> voxelsOfFragments() const = 0;

  /// Voxels at the surface that hold one of `fragments` (rising), in an order that only depends on where they
  /// are. With `places` (world), only those that such voxels connect with one of them, brick by brick: so the
  /// cost follows the region, not the map.
  [[nodiscard]] virtual std::vector<SurfaceVoxel> surfaceOf(std::span<const FragmentId> fragments,
                                                            std::span<const Eigen::Vector3f> places) = 0;
  /// These voxels hold `fragment` from now on.
  virtual void relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment) = 0;
};

}  // namespace scantrove
