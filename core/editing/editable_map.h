#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/editing/surface_graph.h"

namespace scantrove {

/// The map as operations use it. May throw cl::Error.
class EditableMap {
 public:
  virtual ~EditableMap() = default;

  [[nodiscard]] virtual float voxelSize() const = 0;
  /// Number of voxels of each fragment, by fragment number.
  [[nodiscard]] virtual std::span<const int> voxelsOfFragments() const = 0;

  /// Surface voxels of `fragments` (rising) with their colours, in an order that depends only on their
  /// positions. With `places` (world), only those connected to one of the places through such voxels, brick
  /// by brick. The cost then depends on the region, not on the map.
  [[nodiscard]] virtual std::vector<SurfaceVoxel> surfaceOf(std::span<const FragmentId> fragments,
                                                            std::span<const Eigen::Vector3f> places) = 0;
  /// Sets these voxels to `fragment`.
  virtual void relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment) = 0;
};

}  // namespace scantrove
