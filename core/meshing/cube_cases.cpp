#include "core/meshing/cube_cases.h"

#include <pcl/surface/marching_cubes.h>

#include <algorithm>

namespace scantrove {

std::span<const int> trianglesOfCube(unsigned outside) {
  const std::span<const int> edges(pcl::triTable[outside & 255U]);
  return edges.first(static_cast<std::size_t>(std::ranges::find(edges, -1) - edges.begin()));
}

}  // namespace scantrove
