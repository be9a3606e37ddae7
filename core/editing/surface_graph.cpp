#include "core/editing/surface_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/editing/surface_colors.h"

namespace scantrove {
namespace {

/// Edges for each voxel of a surface that is about two voxels thick.
constexpr std::size_t kUsualEdges = 8;

/// The half of a voxel's 26 neighbours that follow it in PositionOrder, in that order.
std::vector<Eigen::Vector3i> laterNeighbors() {
  std::vector<Eigen::Vector3i> steps;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (std::array{x, y, z} > std::array{0, 0, 0}) steps.emplace_back(x, y, z);
      }
    }
  }
  return steps;
}

/// Eq. 3.5 without the distance test, because neighbours in the grid are close.
float weightBetween(const SurfaceVoxel& i, const SurfaceVoxel& j) {
  const float concave = 0.5F * (i.normal_world - j.normal_world).squaredNorm();
  const Eigen::Vector3f step = (j.voxel - i.voxel).cast<float>();
  // From both ends, for symmetry.
  const bool convex = step.dot(j.normal_world) - step.dot(i.normal_world) > 0;
  return convex ? concave * concave : concave;
}

/// A voxel's neighbours at one step follow each other as the voxels do, so one pass along both finds them.
std::vector<SurfaceGraph::Edge> edgesOf(const std::vector<SurfaceVoxel>& voxels) {
  const auto comesFirst = [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() != b.y() ? a.y() < b.y() : a.z() < b.z();
  };
  std::vector<std::uint32_t> order(voxels.size());
  std::iota(order.begin(), order.end(), 0U);
  const bool is_sorted = std::ranges::is_sorted(voxels, comesFirst, &SurfaceVoxel::voxel);
  const auto positionOf = [&](std::uint32_t i) -> const Eigen::Vector3i& { return voxels[i].voxel; };
  if (!is_sorted) std::ranges::sort(order, comesFirst, positionOf);
  std::vector<Eigen::Vector3i> positions(order.size());
  std::ranges::transform(order, positions.begin(), positionOf);

  std::vector<SurfaceGraph::Edge> edges;
  edges.reserve(kUsualEdges * voxels.size());
  const std::vector<Eigen::Vector3i> steps = laterNeighbors();
  std::vector<std::size_t> at(steps.size(), 0);  // the first position that does not come before a step's end
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const Eigen::Vector3i end = positions[i] + steps[s];
      while (at[s] < positions.size() && comesFirst(positions[at[s]], end)) ++at[s];
      if (at[s] == positions.size() || positions[at[s]] != end) continue;
      const auto [a, b] = std::minmax(order[i], order[at[s]]);
      edges.push_back({a, b, weightBetween(voxels[a], voxels[b]), steps[s].cast<float>().norm()});
    }
  }
  if (!is_sorted)
    std::ranges::sort(edges, {}, [](const SurfaceGraph::Edge& edge) { return std::pair(edge.a, edge.b); });
  return edges;
}

void listNeighbors(SurfaceGraph& graph) {
  graph.first.assign(graph.voxels.size() + 1, 0);
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    ++graph.first[edge.a + 1];
    ++graph.first[edge.b + 1];
  }
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  graph.neighbors.resize(2 * graph.edges.size());
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    const auto& [a, b] = std::pair(graph.edges[i].a, graph.edges[i].b);
    graph.neighbors[next[a]++] = {b, i};
    graph.neighbors[next[b]++] = {a, i};
  }
}

Eigen::Vector3f centerOf(const SurfaceVoxel& voxel, float voxel_size_m) {
  return (voxel.voxel.cast<float>() + Eigen::Vector3f::Constant(0.5F)) * voxel_size_m;
}

}  // namespace

SurfaceGraph SurfaceGraph::of(std::vector<SurfaceVoxel> voxels) {
  SurfaceGraph graph;
  graph.voxels = std::move(voxels);
  graph.edges = edgesOf(graph.voxels);
  listNeighbors(graph);
  addColors(graph);
  return graph;
}

std::vector<std::uint32_t> SurfaceGraph::around(const Eigen::Vector3f& place_world, float voxel_size_m,
                                                float radius_m) const {
  std::vector<std::uint32_t> within;
  std::uint32_t nearest = 0;
  float least_m2 = std::numeric_limits<float>::max();
  for (std::uint32_t i = 0; i < voxels.size(); ++i) {
    const float distance_m2 = (centerOf(voxels[i], voxel_size_m) - place_world).squaredNorm();
    if (distance_m2 <= radius_m * radius_m) within.push_back(i);
    if (distance_m2 >= least_m2) continue;
    least_m2 = distance_m2;
    nearest = i;
  }
  if (within.empty() && !voxels.empty()) within.push_back(nearest);
  return within;
}

float turnOf(const SurfaceGraph::Edge& edge) { return std::sqrt(2 * edge.weight); }

}  // namespace scantrove
