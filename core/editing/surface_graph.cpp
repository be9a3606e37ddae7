#include "core/editing/surface_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace scantrove {
namespace {

struct VoxelHash {
  std::size_t operator()(const Eigen::Vector3i& v) const {
    const auto of = [](int value, std::uint64_t factor) {
      return static_cast<std::uint32_t>(value) * factor;
    };
    return of(v.x(), 73856093) ^ of(v.y(), 19349669) ^ of(v.z(), 83492791);
  }
};

/// The half of a voxel's 26 neighbours that follow it in order.
std::vector<Eigen::Vector3i> laterNeighbors() {
  std::vector<Eigen::Vector3i> steps;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        if (std::array{z, y, x} > std::array{0, 0, 0}) steps.emplace_back(x, y, z);
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

Eigen::Vector3f centerOf(const SurfaceVoxel& voxel, float voxel_size_m) {
  return (voxel.voxel.cast<float>() + Eigen::Vector3f::Constant(0.5F)) * voxel_size_m;
}

}  // namespace

SurfaceGraph SurfaceGraph::of(std::vector<SurfaceVoxel> voxels) {
  SurfaceGraph graph;
  graph.voxels = std::move(voxels);
  std::unordered_map<Eigen::Vector3i, std::uint32_t, VoxelHash> place;
  place.reserve(graph.voxels.size());
  for (std::uint32_t i = 0; i < graph.voxels.size(); ++i) place[graph.voxels[i].voxel] = i;
  const std::vector<Eigen::Vector3i> steps = laterNeighbors();
  for (std::uint32_t i = 0; i < graph.voxels.size(); ++i) {
    for (const Eigen::Vector3i& step : steps) {
      const auto found = place.find(graph.voxels[i].voxel + step);
      if (found == place.end()) continue;
      const auto [a, b] = std::minmax(i, found->second);
      graph.edges.push_back(
          {a, b, weightBetween(graph.voxels[a], graph.voxels[b]), step.cast<float>().norm()});
    }
  }
  std::ranges::sort(graph.edges,
                    [](const Edge& x, const Edge& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
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
