#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/segmentation/kernels/edge_layout.h"

namespace scantrove::reference {

/// Eq. 3.5 in double precision for one edge i -> j of points and unit normals towards the camera; none stands
/// for MAXWGHT.
inline std::optional<double> edgeWeight(const Eigen::Vector3d& v_i, const Eigen::Vector3d& n_i,
                                        const Eigen::Vector3d& v_j, const Eigen::Vector3d& n_j,
                                        double d_max) {
  if ((v_i - v_j).norm() >= d_max) return std::nullopt;
  const double concave = 1 - n_i.dot(n_j);
  return (v_j - v_i).dot(n_j) > 0 ? concave * concave : concave;
}

/// The key of a weight in [0, 4], monotonic (edge_layout.h).
[[nodiscard]] inline std::uint16_t edgeKey(float weight) {
  const float floored = weight > EDGE_WEIGHT_FLOOR ? weight : EDGE_WEIGHT_FLOOR;
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(floored) - EDGE_WEIGHT_FLOOR_BITS) >>
                                    EDGE_KEY_SHIFT);
}

}  // namespace scantrove::reference
