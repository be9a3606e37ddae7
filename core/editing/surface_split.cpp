#include "core/editing/surface_split.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <utility>

#include "core/editing/surface_colors.h"
#include "core/editing/surface_paths.h"

namespace scantrove {
namespace {

/// Turns of neighbouring normals below this are noise.
constexpr float kNoise_rad = 0.15F;
/// Path cost per voxel on a smooth surface, in radians of turn.
constexpr float kStep_rad = 0.03F;
/// Turns from here on make an edge cheap to cut.
constexpr float kFold_rad = 0.25F;
/// Colour steps below this are noise.
constexpr float kPlain = 0.7F;
/// Colour steps from here on make an edge cheap to cut.
constexpr float kColorEdge = 2;
/// Path cost of a full colour edge, in radians of turn.
constexpr float kColorEdge_rad = 0.6F;
/// Cost of cutting an edge across the sharpest fold, relative to a smooth surface.
constexpr float kMinCapacity = 0.01F;
/// Cost of assigning a voxel to the farther side, relative to an edge on a smooth surface.
constexpr float kLeaning = 0.2F;
/// How much nearer a voxel is to the side whose colours it has and the other has not.
constexpr float kColorLeaning = 0.3F;

/// 0 on plain surface .. 1 across a colour edge.
float colorEdge(const SurfaceGraph::Edge& edge) {
  const float step = std::max(0.0F, edge.color_step - kPlain) / kColorEdge;
  return 1 - std::exp(-step * step);
}

std::vector<float> pathCosts(const SurfaceGraph& graph) {
  std::vector<float> costs;
  costs.reserve(graph.edges.size());
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    costs.push_back(kStep_rad * edge.length + std::max(0.0F, turnOf(edge) - kNoise_rad) +
                    kColorEdge_rad * colorEdge(edge));
  }
  return costs;
}

/// How much nearer each voxel is to the voxels of one side than to those of the other.
class Nearness {
 public:
  Nearness(const SurfaceGraph& graph, std::span<const std::uint32_t> here,
           std::span<const std::uint32_t> there)
      : graph_(graph), here_(MainColors::of(graph, here)), there_(MainColors::of(graph, there)) {
    const std::vector<float> costs = pathCosts(graph);
    to_here_ = pathLengths(graph, here, costs);
    to_there_ = pathLengths(graph, there, costs);
  }
  [[nodiscard]] bool isReached(std::uint32_t voxel) const {
    return std::isfinite(to_here_[voxel]) || std::isfinite(to_there_[voxel]);
  }
  /// 0 at `here` .. 1 at `there`, of a voxel that is reached.
  [[nodiscard]] float of(std::uint32_t voxel) const {
    if (!std::isfinite(to_here_[voxel])) return 1;
    if (!std::isfinite(to_there_[voxel])) return 0;
    const float both = to_here_[voxel] + to_there_[voxel];
    const float by_path = both > 0 ? to_here_[voxel] / both : 0;
    const bool differs_here = here_.differFrom(graph_, voxel),
               differs_there = there_.differFrom(graph_, voxel);
    if (differs_here == differs_there) return by_path;
    return std::clamp(by_path + (differs_here ? kColorLeaning : -kColorLeaning), 0.0F, 1.0F);
  }

 private:
  const SurfaceGraph& graph_;
  MainColors here_, there_;
  std::vector<float> to_here_, to_there_;
};

/// Side of a voxel that the cut decides.
constexpr std::uint8_t kOpen = 2;

/// Decides the open voxels by a minimum cut. Given voxels are no vertices, which keeps the graph small where
/// a stroke has many surroundings: an edge to one of them ties the open voxel to that side.
void cutOpen(const SurfaceGraph& graph, const Nearness& nearness, std::vector<std::uint8_t>& side) {
  constexpr int kNone = -1;
  cv::detail::GCGraph<float> flow;
  flow.create(static_cast<unsigned>(std::ranges::count(side, kOpen)) + 2, 0);
  const int first = flow.addVtx();
  flow.addEdges(first, flow.addVtx(), 0, 0);  // GCGraph needs an edge, even if no two open voxels touch
  std::vector<int> vertices(side.size(), kNone);
  for (std::uint32_t voxel = 0; voxel < side.size(); ++voxel) {
    if (side[voxel] != kOpen) continue;
    vertices[voxel] = flow.addVtx();
    const float to_there = nearness.of(voxel);
    flow.addTermWeights(vertices[voxel], kLeaning * (1 - to_there), kLeaning * to_there);
  }
  const auto tie = [&](std::uint32_t open, std::uint32_t given, float capacity) {
    flow.addTermWeights(vertices[open], side[given] == 0 ? capacity : 0, side[given] == 0 ? 0 : capacity);
  };
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    const int a = vertices[edge.a], b = vertices[edge.b];
    if (a == kNone && b == kNone) continue;
    const float capacity = cutCost(edge);
    if (a == kNone) {
      tie(edge.b, edge.a, capacity);
    } else if (b == kNone) {
      tie(edge.a, edge.b, capacity);
    } else {
      flow.addEdges(a, b, capacity, capacity);
    }
  }
  flow.maxFlow();
  for (std::size_t voxel = 0; voxel < side.size(); ++voxel) {
    if (vertices[voxel] != kNone) side[voxel] = flow.inSourceSegment(vertices[voxel]) ? 0 : 1;
  }
}

/// Gives pieces of a side that hold none of its given voxels to the other side, if that surrounds them.
void assignIslands(const SurfaceGraph& graph, std::span<const std::uint32_t> here,
                   std::span<const std::uint32_t> there, std::vector<std::uint8_t>& side) {
  for (const bool is_there : {false, true}) {
    std::vector<std::uint8_t> belongs(side.size());
    for (std::size_t voxel = 0; voxel < side.size(); ++voxel)
      belongs[voxel] = (side[voxel] != 0) == is_there ? 1 : 0;
    const SurfacePieces pieces = piecesOf(graph, belongs);
    std::vector<std::uint8_t> stays(pieces.sizes.size(), 0), touches(pieces.sizes.size(), 0);
    for (const std::uint32_t voxel : is_there ? there : here) {
      if (belongs[voxel] != 0) stays[pieces.piece[voxel]] = 1;
    }
    for (const SurfaceGraph::Edge& edge : graph.edges) {
      if (belongs[edge.a] == belongs[edge.b]) continue;
      touches[pieces.piece[belongs[edge.a] != 0 ? edge.a : edge.b]] = 1;
    }
    for (std::size_t voxel = 0; voxel < side.size(); ++voxel) {
      if (belongs[voxel] == 0) continue;
      const std::uint32_t piece = pieces.piece[voxel];
      if (stays[piece] == 0 && touches[piece] != 0) side[voxel] = is_there ? 0 : 1;
    }
  }
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

/// Joins components that are still too small, because nothing touches them, with the largest.
void joinSmallest(Components& components, std::size_t voxels, int min_voxels) {
  std::uint32_t largest = 0;
  for (std::uint32_t voxel = 0; voxel < voxels; ++voxel) {
    const std::uint32_t component = components.of(voxel);
    if (components.size(component) > components.size(components.of(largest))) largest = component;
  }
  for (std::uint32_t voxel = 0; voxel < voxels; ++voxel) {
    const std::uint32_t component = components.of(voxel), into = components.of(largest);
    if (component != into && components.size(component) < min_voxels) components.join(component, into, 0);
  }
}

}  // namespace

float cutCost(const SurfaceGraph::Edge& edge) {
  const float turn = turnOf(edge) / kFold_rad;
  return std::exp(-turn * turn) * (1 - colorEdge(edge)) + kMinCapacity;
}

std::vector<std::uint8_t> splitSurface(const SurfaceGraph& graph, std::span<const std::uint32_t> here,
                                       std::span<const std::uint32_t> there) {
  const Nearness nearness(graph, here, there);
  std::vector<std::uint8_t> side(graph.voxels.size(), kOpen);
  for (const std::uint32_t voxel : here) side[voxel] = 0;
  for (const std::uint32_t voxel : there) side[voxel] = 1;
  for (std::uint32_t voxel = 0; voxel < side.size(); ++voxel) {
    if (!nearness.isReached(voxel)) side[voxel] = 0;
  }
  cutOpen(graph, nearness, side);
  assignIslands(graph, here, there, side);
  return side;
}

std::vector<std::uint32_t> segmentSurface(const SurfaceGraph& graph, float k, int min_voxels,
                                          SurfaceCues cues) {
  std::vector<SurfaceGraph::Edge> edges = graph.edges;
  if (cues == SurfaceCues::folds_and_colors) {
    for (SurfaceGraph::Edge& edge : edges) {
      const float turn = kColorEdge_rad * colorEdge(edge);
      edge.weight += 0.5F * turn * turn;
    }
  }
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
  joinSmallest(components, graph.voxels.size(), min_voxels);
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
