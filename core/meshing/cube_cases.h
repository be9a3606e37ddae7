#pragma once
#include <array>
#include <span>

namespace scantrove {

/// Corners of a cube of side 1 as marching cubes (Lorensen and Cline 1987) numbers them.
inline constexpr std::array<std::array<int, 3>, 8> kCubeCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// An edge of the cube: from the corner `start` one step along `axis`.
struct CubeEdge {
  std::array<int, 3> start;
  int axis;
};
inline constexpr std::array<CubeEdge, 12> kCubeEdges{{{{0, 0, 0}, 0},
                                                      {{1, 0, 0}, 1},
                                                      {{0, 1, 0}, 0},
                                                      {{0, 0, 0}, 1},
                                                      {{0, 0, 1}, 0},
                                                      {{1, 0, 1}, 1},
                                                      {{0, 1, 1}, 0},
                                                      {{0, 0, 1}, 1},
                                                      {{0, 0, 0}, 2},
                                                      {{1, 0, 0}, 2},
                                                      {{1, 1, 0}, 2},
                                                      {{0, 1, 0}, 2}}};

/// Triangles between the corners outside (bit i: corner i) and those inside: the edge numbers of their
/// vertices, three per triangle, counter-clockwise seen from outside. Triangles of neighbouring cubes match
/// at the common face.
[[nodiscard]] std::span<const int> trianglesOfCube(unsigned outside);

}  // namespace scantrove
