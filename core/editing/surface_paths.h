#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/editing/surface_graph.h"

namespace scantrove {

/// Length of the shortest path to each voxel from the nearest of `from` (Dijkstra); infinite where none
/// leads. `costs`: of each edge of the graph, not negative. Any thread.
[[nodiscard]] std::vector<float> pathLengths(const SurfaceGraph& graph, std::span<const std::uint32_t> from,
                                             std::span<const float> costs);

/// The connected components of the voxels that `belongs` marks, over all edges between such voxels.
struct SurfacePieces {
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> piece;  ///< of each voxel; kNone where it is not marked
  std::vector<std::size_t> sizes;    ///< voxels of each piece, in the order of their first voxels
};
[[nodiscard]] SurfacePieces piecesOf(const SurfaceGraph& graph, std::span<const std::uint8_t> belongs);

}  // namespace scantrove
