#include "core/editing/surface_paths.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace scantrove {

std::vector<float> pathLengths(const SurfaceGraph& graph, std::span<const std::uint32_t> from,
                               std::span<const float> costs) {
  std::vector<float> lengths(graph.voxels.size(), std::numeric_limits<float>::infinity());
  using Front = std::pair<float, std::uint32_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front;
  for (const std::uint32_t voxel : from) {
    lengths[voxel] = 0;
    front.emplace(0.0F, voxel);
  }
  while (!front.empty()) {
    const auto [length, voxel] = front.top();
    front.pop();
    if (length > lengths[voxel]) continue;
    for (const SurfaceGraph::Neighbor& next : graph.neighborsOf(voxel)) {
      const float way = length + costs[next.edge];
      if (way >= lengths[next.voxel]) continue;
      lengths[next.voxel] = way;
      front.emplace(way, next.voxel);
    }
  }
  return lengths;
}

SurfacePieces piecesOf(const SurfaceGraph& graph, std::span<const std::uint8_t> belongs) {
  SurfacePieces pieces;
  pieces.piece.assign(graph.voxels.size(), SurfacePieces::kNone);
  std::vector<std::uint32_t> front;
  for (std::uint32_t start = 0; start < graph.voxels.size(); ++start) {
    if (belongs[start] == 0 || pieces.piece[start] != SurfacePieces::kNone) continue;
    const auto number = static_cast<std::uint32_t>(pieces.sizes.size());
    pieces.sizes.push_back(0);
    pieces.piece[start] = number;
    front.assign(1, start);
    while (!front.empty()) {
      const std::uint32_t voxel = front.back();
      front.pop_back();
      ++pieces.sizes.back();
      for (const SurfaceGraph::Neighbor& next : graph.neighborsOf(voxel)) {
        if (belongs[next.voxel] == 0 || pieces.piece[next.voxel] != SurfacePieces::kNone) continue;
        pieces.piece[next.voxel] = number;
        front.push_back(next.voxel);
      }
    }
  }
  return pieces;
}

}  // namespace scantrove
