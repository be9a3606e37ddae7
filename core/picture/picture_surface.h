#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/exchange/region_palette.h"

namespace scantrove {

/// Triangles to be drawn.
struct PictureSurface {
  struct Vertex {
    Eigen::Vector3f position_world_m = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();  ///< unit length; zero: that of the face is used
    Rgb color{};
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< counter-clockwise, seen from outside
  std::vector<Rgb> face_colors;                     ///< one a face; empty: those of the vertices
};

}  // namespace scantrove
