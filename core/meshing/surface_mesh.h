#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The surface of a map as triangles. Neighbours share vertices; every edge belongs to two triangles, or to
/// one at the border of the seen surface.
struct SurfaceMesh {
  struct Vertex {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< world, metres
    Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();   ///< unit, out of the surface
    std::array<std::uint8_t, 3> color{};                 ///< red, green, blue
    bool has_color = false;                              ///< false: no colour here or around
    FragmentId fragment;                                 ///< 0: no label here or around

    bool operator==(const Vertex&) const = default;
  };

  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< counter-clockwise, seen from outside

  bool operator==(const SurfaceMesh&) const = default;
};

}  // namespace scantrove
