#include "core/texturing/face_neighbors.h"

#include <algorithm>
#include <utility>

namespace scantrove {

FaceNeighbors neighborsOf(std::span<const FaceCorners> faces) {
  struct Edge {
    std::uint64_t key;
    std::uint32_t face, number;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint64_t a = faces[f][i], b = faces[f][(i + 1) % 3];
      edges.push_back({std::min(a, b) << 32U | std::max(a, b), f, i});
    }
  }
  std::ranges::sort(edges, [](const Edge& a, const Edge& b) {
    return std::pair(a.key, a.face) < std::pair(b.key, b.face);
  });
  FaceNeighbors neighbors(faces.size(), {kNoFace, kNoFace, kNoFace});
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a.key != b.key || a.face == b.face) continue;
    neighbors[a.face][a.number] = b.face;
    neighbors[b.face][b.number] = a.face;
    ++i;
  }
  return neighbors;
}

}  // namespace scantrove
