#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// A labelled voxel at the surface of the map.
struct SurfaceVoxel {
  Eigen::Vector3i voxel = Eigen::Vector3i::Zero();  ///< brick_layout.h
  Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();
  FragmentId fragment;
};

/// Voxels at the surface, and an edge between any two that touch (26 neighbours). The weight is that of
/// thesis eq. 3.5: 1 - cos of the angle between the normals, squared where the surface is convex.
struct SurfaceGraph {
  struct Edge {
    std::uint32_t a = 0, b = 0;  ///< voxels, a < b
    float weight = 0;
    float length = 0;  ///< voxels: 1, sqrt 2 or sqrt 3
  };
  std::vector<SurfaceVoxel> voxels;
  std::vector<Edge> edges;  ///< by a, then b

  /// Builds the graph in the order of `voxels`, which must be unique.
  [[nodiscard]] static SurfaceGraph of(std::vector<SurfaceVoxel> voxels);

  /// Voxels within `radius_m` of a place in the world, or else the nearest one.
  [[nodiscard]] std::vector<std::uint32_t> around(const Eigen::Vector3f& place_world, float voxel_size_m,
                                                  float radius_m) const;
};

/// The turn across an edge in radians, for small turns: full for a fold, much less for a ridge.
[[nodiscard]] float turnOf(const SurfaceGraph::Edge& edge);

}  // namespace scantrove
