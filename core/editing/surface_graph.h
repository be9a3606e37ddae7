#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// A labelled voxel at the surface of the map.
struct SurfaceVoxel {
  Eigen::Vector3i voxel = Eigen::Vector3i::Zero();  ///< brick_layout.h
  Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();
  FragmentId fragment;
  std::optional<std::array<std::uint8_t, 3>> rgb = {};  ///< none: never seen in colour
};

/// Voxels at the surface, and an edge between any two that touch (26 neighbours). The weight is that of
/// thesis eq. 3.5: 1 - cos of the angle between the normals, squared where the surface is convex. The colour
/// step is that of surface_colors.h.
struct SurfaceGraph {
  struct Edge {
    std::uint32_t a = 0, b = 0;  ///< voxels, a < b
    float weight = 0;
    float length = 0;      ///< voxels: 1, sqrt 2 or sqrt 3
    float color_step = 0;  ///< colour difference relative to the local variation; 0 where a colour is unknown
  };
  struct Neighbor {
    std::uint32_t voxel = 0, edge = 0;
  };
  std::vector<SurfaceVoxel> voxels;
  std::vector<Edge> edges;             ///< by a, then b
  std::vector<std::uint32_t> first;    ///< voxels.size() + 1: voxel i has neighbors [first[i], first[i + 1])
  std::vector<Neighbor> neighbors;     ///< of voxel after voxel, by edge
  std::vector<Eigen::Vector3f> tints;  ///< tintsOf(), smoothed; empty if no voxel has a colour
  std::vector<float> color_variation;  ///< of each voxel, in Lab units; empty like `tints`

  /// Builds the graph in the order of `voxels`, which must be unique. It is quick if they are in the order of
  /// their positions: x, then y, then z.
  [[nodiscard]] static SurfaceGraph of(std::vector<SurfaceVoxel> voxels);

  [[nodiscard]] std::span<const Neighbor> neighborsOf(std::uint32_t voxel) const {
    return std::span(neighbors).subspan(first[voxel], first[voxel + 1] - first[voxel]);
  }

  /// Voxels within `radius_m` of a place in the world, or else the nearest one.
  [[nodiscard]] std::vector<std::uint32_t> around(const Eigen::Vector3f& place_world, float voxel_size_m,
                                                  float radius_m) const;
};

/// The turn across an edge in radians, for small turns: full for a fold, much less for a ridge.
[[nodiscard]] float turnOf(const SurfaceGraph::Edge& edge);

}  // namespace scantrove
