#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

struct BrickShading {
  std::vector<std::uint8_t> shade;  ///< one for each point, 255 = fully lit
  Eigen::Vector3f normal =
      Eigen::Vector3f::Zero();  ///< of the whole brick, length = number of points, sign arbitrary
};

/// Gives points a shape without normals in the snapshot: surface normals from the points around each corner
/// of the brick's 2 x 2 x 2 cells (principal components, Gaussian weights), lit from a fixed direction on
/// both sides.
[[nodiscard]] BrickShading shadeBrick(const CloudBrick& brick, float voxel_size_m);

}  // namespace scantrove
