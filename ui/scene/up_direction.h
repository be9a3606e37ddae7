#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace scantrove {

/// The direction away from the floor, from surface normals (any sign, any length = weight) and the axes of
/// the sensor that sees them (camera to world: x right, y down, z forward): the strongest direction among
/// those in which a sensor is held, looking ahead or down and not rolled far. Floors, tables and seats
/// outvote the rest. Returns the sensor's own "up" when there are too few surfaces.
[[nodiscard]] Eigen::Vector3f findUp(const std::vector<Eigen::Vector3f>& normals,
                                     const Eigen::Matrix3f& R_world_camera);

}  // namespace scantrove
