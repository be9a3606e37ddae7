#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace scantrove {

/// The direction away from the floor, from surface normals (any sign, any length = weight): the strongest
/// direction within 50 degrees of `first_guess` (unit). Floors, tables and seats outvote the rest. Returns
/// the guess when there are too few surfaces.
[[nodiscard]] Eigen::Vector3f findUp(const std::vector<Eigen::Vector3f>& normals,
                                     const Eigen::Vector3f& first_guess);

}  // namespace scantrove
