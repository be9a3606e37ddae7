#include "core/meshing/cube_cases.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace scantrove {
namespace {

using Segment = std::pair<int, int>;  ///< two cube edges that a triangle side connects, in its direction

Eigen::Vector3d middleOf(int edge) {
  const CubeEdge& e = kCubeEdges[static_cast<std::size_t>(edge)];
  return Eigen::Vector3i(e.start.data()).cast<double>() + 0.5 * Eigen::Vector3d::Unit(e.axis);
}

bool liesOn(int edge, int axis, int side) { return middleOf(edge)[axis] == side; }

bool isOutside(unsigned outside, const std::array<int, 3>& corner) {
  for (unsigned i = 0; i < kCubeCorners.size(); ++i) {
    if (kCubeCorners[i] == corner) return (outside >> i & 1U) != 0;
  }
  return false;
}

/// Segments of all triangles, with their number of uses.
std::map<Segment, int> segmentsOf(unsigned outside) {
  std::map<Segment, int> segments;
  const std::span<const int> edges = trianglesOfCube(outside);
  for (std::size_t i = 0; i < edges.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++segments[{edges[i + k], edges[i + (k + 1) % 3]}];
  }
  return segments;
}

/// Segments of one triangle only: the boundary of the surface within the cube.
std::vector<Segment> openSegmentsOf(unsigned outside) {
  std::vector<Segment> open;
  const std::map<Segment, int> segments = segmentsOf(outside);
  for (const auto& [segment, count] : segments) {
    if (!segments.contains({segment.second, segment.first})) open.push_back(segment);
  }
  return open;
}

TEST(CubeCases, VerticesLieOnCrossedEdges) {
  for (unsigned outside = 0; outside < 256; ++outside) {
    std::set<int> crossed;
    for (int edge = 0; edge < 12; ++edge) {
      const CubeEdge& e = kCubeEdges[static_cast<std::size_t>(edge)];
      std::array<int, 3> end = e.start;
      ++end[static_cast<std::size_t>(e.axis)];
      if (isOutside(outside, e.start) != isOutside(outside, end)) crossed.insert(edge);
    }
    const std::span<const int> edges = trianglesOfCube(outside);
    EXPECT_EQ(edges.size() % 3, 0U);
    EXPECT_EQ(std::set<int>(edges.begin(), edges.end()), crossed) << outside;
  }
}

TEST(CubeCases, TrianglesFaceOutwards) {
  for (unsigned i = 0; i < kCubeCorners.size(); ++i) {
    for (const bool one_outside : {true, false}) {
      const unsigned corner = 1U << i;
      const std::span<const int> edges = trianglesOfCube(one_outside ? corner : 255U ^ corner);
      ASSERT_EQ(edges.size(), 3U);
      const Eigen::Vector3d a = middleOf(edges[0]);
      const Eigen::Vector3d normal = (middleOf(edges[1]) - a).cross(middleOf(edges[2]) - a);
      const Eigen::Vector3d to_corner = Eigen::Vector3i(kCubeCorners[i].data()).cast<double>() - a;
      EXPECT_EQ(normal.dot(to_corner) > 0, one_outside);
    }
  }
}

// This closes meshes: each edge belongs to two triangles, even across ambiguous faces.
TEST(CubeCases, NeighborsMatch_InEveryCase) {
  // Open segments in a face by axis and its four corners: those of the cube below and those of the cube
  // above.
  std::map<std::pair<int, std::vector<bool>>, std::set<Segment>> below, above;
  for (unsigned outside = 0; outside < 256; ++outside) {
    for (const auto& [segment, count] : segmentsOf(outside)) ASSERT_EQ(count, 1) << outside;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::vector<bool> corners;
        for (int i = 0; i < 4; ++i) {
          std::array<int, 3> corner{};
          corner[static_cast<std::size_t>(axis)] = side;
          corner[static_cast<std::size_t>((axis + 1) % 3)] = i & 1;
          corner[static_cast<std::size_t>((axis + 2) % 3)] = i >> 1;
          corners.push_back(isOutside(outside, corner));
        }
        // The number of the parallel edge in the opposite face; names the same edge in both cubes.
        const auto onLowSide = [&](int edge) {
          for (int other = 0; other < 12; ++other) {
            if (middleOf(other) + side * Eigen::Vector3d::Unit(axis) == middleOf(edge)) return other;
          }
          return -1;
        };
        std::set<Segment> open;
        for (const auto& [a, b] : openSegmentsOf(outside)) {
          if (liesOn(a, axis, side) && liesOn(b, axis, side)) open.insert({onLowSide(a), onLowSide(b)});
        }
        auto& of_faces = side == 1 ? below : above;
        const auto [known, is_new] = of_faces.try_emplace({axis, corners}, open);
        EXPECT_EQ(known->second, open) << "case " << outside;
      }
    }
    // All other segments lie inside the cube, never in a face that it shares with a neighbour.
    for (const auto& [segment, count] : segmentsOf(outside)) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          const bool in_face = liesOn(segment.first, axis, side) && liesOn(segment.second, axis, side);
          const bool is_open = !segmentsOf(outside).contains({segment.second, segment.first});
          EXPECT_TRUE(!in_face || is_open) << "case " << outside;
        }
      }
    }
    for (const auto& [a, b] : openSegmentsOf(outside)) {
      bool in_a_face = false;
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) in_a_face |= liesOn(a, axis, side) && liesOn(b, axis, side);
      }
      EXPECT_TRUE(in_a_face) << "case " << outside << " has a hole";
    }
  }
  ASSERT_EQ(below.size(), 48U);
  for (const auto& [face, open] : below) {
    std::set<Segment> turned;
    for (const auto& [a, b] : open) turned.insert({b, a});
    EXPECT_EQ(above.at(face), turned);
  }
}

}  // namespace
}  // namespace scantrove
