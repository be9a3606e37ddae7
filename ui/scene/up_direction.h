#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace scantrove {

/// Finds up from surface normals (any sign, length = weight) and the sensor's rotation (camera to world: x
/// right, y down, z forward). It is the most frequent normal among the plausible up directions of a sensor
/// that looks ahead or down. With too few normals, returns the sensor's own "up".
[[nodiscard]] Eigen::Vector3f findUp(const std::vector<Eigen::Vector3f>& normals,
                                     const Eigen::Matrix3f& R_world_camera);

}  // namespace scantrove
