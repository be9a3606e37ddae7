#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace scantrove::reference {

using Voxel = std::array<int, 3>;

/// The voxel or brick that contains a coordinate in metres: floor(p / side). Voxel 0 spans [0, side), voxel
/// -1 spans
/// [-side, 0).
[[nodiscard]] inline int cellOf(double p_m, double side_m) {
  return static_cast<int>(std::floor(p_m / side_m));
}

/// S_prj,t of one vertex (world, metres, w = 0: no surface): the label of its voxel, 0 if none.
[[nodiscard]] inline std::uint32_t projectedLabel(const Eigen::Vector4f& vertex, double voxel_size_m,
                                                  const std::map<Voxel, std::uint32_t>& labels) {
  if (!(vertex.w() > 0)) return 0;
  const auto found = labels.find({cellOf(static_cast<double>(vertex.x()), voxel_size_m),
                                  cellOf(static_cast<double>(vertex.y()), voxel_size_m),
                                  cellOf(static_cast<double>(vertex.z()), voxel_size_m)});
  return found == labels.end() ? 0 : found->second;
}

/// One voxel with a fragment near the surface.
struct SurfacePoint {
  Eigen::Vector3d center_m;  ///< world
  std::uint32_t fragment = 0;
  Eigen::Vector3d normal;  ///< zero if no neighbour determines it
};

/// The state of a voxel.
struct FusedVoxel {
  double distance = 0;  ///< signed, in truncations
  bool seen = false;
  std::uint32_t fragment = 0;
};

/// The gradient of the distance at a voxel from its seen neighbours in the brick. Along each axis it is the
/// slope between both neighbours, or between one neighbour and the voxel.
[[nodiscard]] inline Eigen::Vector3d normalInBrick(
    const Eigen::Vector3i& local, const std::function<FusedVoxel(const Eigen::Vector3i& local)>& voxel_at) {
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<int, double>> known{{0, voxel_at(local).distance}};
    for (const int step : {-1, 1}) {
      const Eigen::Vector3i beside = local + step * Eigen::Vector3i::Unit(axis);
      if (beside[axis] < 0 || beside[axis] > 7 || !voxel_at(beside).seen) continue;
      known.emplace_back(step, voxel_at(beside).distance);
    }
    const auto [first, last] = std::ranges::minmax_element(known);
    if (first->first != last->first) {
      slope[axis] = (last->second - first->second) / (last->first - first->first);
    }
  }
  return slope.squaredNorm() > 0 ? slope.normalized() : slope;
}

/// The points of one brick of 8^3 voxels, x fastest: seen voxels with a fragment within one voxel of the
/// surface.
[[nodiscard]] inline std::vector<SurfacePoint> pointsOfBrick(
    const Eigen::Vector3i& brick, double voxel_size_m, double truncation_vox,
    const std::function<FusedVoxel(const Eigen::Vector3i& local)>& voxel_at) {
  std::vector<SurfacePoint> points;
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const FusedVoxel voxel = voxel_at({x, y, z});
        if (!voxel.seen || voxel.fragment == 0 || std::abs(voxel.distance) * truncation_vox > 1) continue;
        const Eigen::Vector3i position = 8 * brick + Eigen::Vector3i(x, y, z);
        points.push_back({(position.cast<double>().array() + 0.5) * voxel_size_m, voxel.fragment,
                          normalInBrick({x, y, z}, voxel_at)});
      }
    }
  }
  return points;
}

}  // namespace scantrove::reference
