#pragma once
#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <optional>

namespace scantrove::reference {

/// A signed distance sampled at voxel centres; none for unseen voxels.
using VoxelField = std::function<std::optional<double>(const Eigen::Vector3i& voxel)>;

/// Trilinear value at p (in voxels) of the seen corners, if they have at least half of the weight.
[[nodiscard]] inline std::optional<double> trilinear(const VoxelField& field, const Eigen::Vector3d& p) {
  const Eigen::Vector3d base = (p.array() - 0.5).floor();
  const Eigen::Vector3d w = p.array() - 0.5 - base.array();
  double sum = 0;
  double total = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i offset(corner & 1, (corner >> 1) & 1, corner >> 2);
    const std::optional<double> value = field(base.cast<int>() + offset);
    if (!value) continue;
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= offset[axis] ? w[axis] : 1 - w[axis];
    sum += weight * *value;
    total += weight;
  }
  if (total < 0.5) return std::nullopt;
  return sum / total;
}

/// The parameter of the first change from + to - along origin + t * direction (voxels) in (t_from, t_to),
/// found in small steps. None if the field changes from - to + first.
[[nodiscard]] inline std::optional<double> firstSurface(const VoxelField& field,
                                                        const Eigen::Vector3d& origin,
                                                        const Eigen::Vector3d& direction, double t_from,
                                                        double t_to, double step_vox = 0.25) {
  const double step = step_vox / direction.norm();
  std::optional<double> before;
  for (double t = t_from; t < t_to; t += step) {
    const std::optional<double> now = trilinear(field, origin + t * direction);
    if (before && now) {
      if (*before > 0 && *now <= 0) return t - step + step * *before / (*before - *now);
      if (*before < 0 && *now > 0) return std::nullopt;
    }
    before = now;
  }
  return std::nullopt;
}

}  // namespace scantrove::reference
