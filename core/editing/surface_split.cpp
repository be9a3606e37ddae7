#include "core/editing/surface_split.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <queue>
#include <utility>

namespace scantrove {
namespace {

/// Turns of neighbouring normals below this are noise.
constexpr float kNoise_rad = 0.15F;
/// Path cost per voxel on a smooth surface, in radians of turn.
constexpr float kStep_rad = 0.03F;
/// Turns from here on make an edge cheap to cut.
constexpr float kFold_rad = 0.25F;
/// Cost of cutting an edge across the sharpest fold, relative to a smooth surface.
constexpr float kMinCapacity = 0.01F;
/// Cost of assigning a voxel to the farther side, relative to an edge on a smooth surface.
constexpr float kLeaning = 0.2F;
constexpr float kCertain = 1e6F;

struct Neighbor {
  std::uint32_t voxel;
  float cost;
};

std::vector<std::vector<Neighbor>> neighborsOf(const SurfaceGraph& graph) {
  std::vector<std::vector<Neighbor>> neighbors(graph.voxels.size());
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    const float cost = kStep_rad * edge.length + std::max(0.0F, turnOf(edge) - kNoise_rad);
    neighbors[edge.a].push_back({edge.b, cost});
    neighbors[edge.b].push_back({edge.a, cost});
  }
  return neighbors;
}

/// Length of the shortest path along the surface from the nearest of `from` (Dijkstra).
std::vector<float> distancesFrom(std::span<const std::uint32_t> from,
                                 const std::vector<std::vector<Neighbor>>& neighbors) {
  std::vector<float> distances(neighbors.size(), std::numeric_limits<float>::infinity());
  using Front = std::pair<float, std::uint32_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front;
  for (const std::uint32_t voxel : from) {
    distances[voxel] = 0;
    front.emplace(0.0F, voxel);
  }
  while (!front.empty()) {
    const auto [distance, voxel] = front.top();
    front.pop();
    if (distance > distances[voxel]) continue;
    for (const Neighbor& next : neighbors[voxel]) {
      const float way = distance + next.cost;
      if (way >= distances[next.voxel]) continue;
      distances[next.voxel] = way;
      front.emplace(way, next.voxel);
    }
  }
  return distances;
}

float capacityOf(const SurfaceGraph::Edge& edge) {
  const float turn = turnOf(edge) / kFold_rad;
  return std::exp(-turn * turn) + kMinCapacity;
}

/// The components of voxels.
class Components {
 public:
  explicit Components(std::size_t voxels) : parent_(voxels), size_(voxels, 1), inner_(voxels, 0) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t of(std::uint32_t voxel) {
    while (parent_[voxel] != voxel) voxel = parent_[voxel] = parent_[parent_[voxel]];
    return voxel;
  }
  void join(std::uint32_t a, std::uint32_t b, float weight) {
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
    inner_[a] = weight;
  }
  [[nodiscard]] int size(std::uint32_t component) const { return size_[component]; }
  /// Int(C) + k / |C|.
  [[nodiscard]] float threshold(std::uint32_t component, float k) const {
    return inner_[component] + k / static_cast<float>(size_[component]);
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<int> size_;
  std::vector<float> inner_;  // the largest weight within
};

}  // namespace

std::vector<std::uint8_t> splitSurface(const SurfaceGraph& graph, std::span<const std::uint32_t> here,
                                       std::span<const std::uint32_t> there) {
  const auto neighbors = neighborsOf(graph);
  const std::vector<float> to_here = distancesFrom(here, neighbors);
  const std::vector<float> to_there = distancesFrom(there, neighbors);
  const auto isReached = [&](std::size_t voxel) {
    return std::isfinite(to_here[voxel]) || std::isfinite(to_there[voxel]);
  };

  cv::detail::GCGraph<float> flow(static_cast<unsigned>(graph.voxels.size()),
                                  static_cast<unsigned>(2 * graph.edges.size()));
  for (std::size_t voxel = 0; voxel < graph.voxels.size(); ++voxel) {
    const int vertex = flow.addVtx();
    if (!isReached(voxel)) continue;
    float nearness = 0;  // 0 at `here` .. 1 at `there`
    if (!std::isfinite(to_here[voxel])) {
      nearness = 1;
    } else if (std::isfinite(to_there[voxel]) && to_here[voxel] + to_there[voxel] > 0) {
      nearness = to_here[voxel] / (to_here[voxel] + to_there[voxel]);
    }
    flow.addTermWeights(vertex, kLeaning * (1 - nearness), kLeaning * nearness);
  }
  for (const std::uint32_t voxel : here) flow.addTermWeights(static_cast<int>(voxel), kCertain, 0);
  for (const std::uint32_t voxel : there) flow.addTermWeights(static_cast<int>(voxel), 0, kCertain);
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    const float capacity = capacityOf(edge);
    flow.addEdges(static_cast<int>(edge.a), static_cast<int>(edge.b), capacity, capacity);
  }
  flow.maxFlow();
  std::vector<std::uint8_t> side(graph.voxels.size(), 0);
  for (std::size_t voxel = 0; voxel < side.size(); ++voxel) {
    if (isReached(voxel)) side[voxel] = flow.inSourceSegment(static_cast<int>(voxel)) ? 0 : 1;
  }
  return side;
}

std::vector<std::uint32_t> segmentSurface(const SurfaceGraph& graph, float k, int min_voxels) {
  std::vector<SurfaceGraph::Edge> edges = graph.edges;
  std::ranges::stable_sort(edges, {}, &SurfaceGraph::Edge::weight);
  Components components(graph.voxels.size());
  for (const SurfaceGraph::Edge& edge : edges) {
    const std::uint32_t a = components.of(edge.a), b = components.of(edge.b);
    if (a != b && edge.weight <= std::min(components.threshold(a, k), components.threshold(b, k)))
      components.join(a, b, edge.weight);
  }
  for (const SurfaceGraph::Edge& edge : edges) {
    const std::uint32_t a = components.of(edge.a), b = components.of(edge.b);
    if (a != b && std::min(components.size(a), components.size(b)) < min_voxels)
      components.join(a, b, edge.weight);
  }
  std::vector<std::uint32_t> part(graph.voxels.size());
  std::vector<std::uint32_t> number(graph.voxels.size(), std::numeric_limits<std::uint32_t>::max());
  std::uint32_t parts = 0;
  for (std::uint32_t voxel = 0; voxel < part.size(); ++voxel) {
    std::uint32_t& of_root = number[components.of(voxel)];
    if (of_root == std::numeric_limits<std::uint32_t>::max()) of_root = parts++;
    part[voxel] = of_root;
  }
  return part;
}

}  // namespace scantrove
