#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/meshing/surface_mesh.h"

namespace scantrove::test {

/// Numbers of faults of a mesh.
struct MeshFaults {
  int not_finite = 0;       ///< vertices
  int bad_normals = 0;      ///< not of length 1
  int unused = 0;           ///< vertices
  int without_area = 0;     ///< faces
  int duplicate_faces = 0;  ///< faces with the vertices of another
  int edges_of_many = 0;    ///< edges that two faces use in the same direction
  int duplicates = 0;       ///< vertices at the position of another
};

inline MeshFaults faultsOf(const SurfaceMesh& mesh) {
  MeshFaults faults;
  std::set<std::array<float, 3>> positions;
  for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
    faults.not_finite += !vertex.position.allFinite() || !vertex.normal.allFinite() ? 1 : 0;
    faults.bad_normals += std::abs(vertex.normal.norm() - 1) > 1e-4F ? 1 : 0;
    const Eigen::Vector3f& p = vertex.position;
    faults.duplicates += positions.insert({p.x(), p.y(), p.z()}).second ? 0 : 1;
  }
  std::vector<bool> used(mesh.vertices.size(), false);
  std::set<std::array<std::uint32_t, 3>> faces;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::array<std::uint32_t, 3>& face : mesh.faces) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      used.at(face[i]) = true;
      p[i] = mesh.vertices[face[i]].position.cast<double>();
      faults.edges_of_many += edges.insert({face[i], face[(i + 1) % 3]}).second ? 0 : 1;
    }
    faults.without_area += (p[1] - p[0]).cross(p[2] - p[0]).norm() > 0 ? 0 : 1;
    std::array<std::uint32_t, 3> sorted = face;
    std::ranges::sort(sorted);
    faults.duplicate_faces += faces.insert(sorted).second ? 0 : 1;
  }
  faults.unused = static_cast<int>(std::ranges::count(used, false));
  return faults;
}

inline void expectNoFaults(const SurfaceMesh& mesh) {
  const MeshFaults faults = faultsOf(mesh);
  EXPECT_EQ(faults.not_finite, 0);
  EXPECT_EQ(faults.bad_normals, 0);
  EXPECT_EQ(faults.unused, 0);
  EXPECT_EQ(faults.without_area, 0);
  EXPECT_EQ(faults.duplicate_faces, 0);
  EXPECT_EQ(faults.edges_of_many, 0);
  EXPECT_EQ(faults.duplicates, 0);
}

/// Start vertices of edges with only one face.
inline std::vector<std::uint32_t> borderOf(const SurfaceMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert({face[i], face[(i + 1) % 3]});
  }
  std::vector<std::uint32_t> border;
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) border.push_back(a);
  }
  return border;
}

/// The volume of a closed mesh; positive if its faces point outwards.
inline double volumeOf(const SurfaceMesh& mesh) {
  double volume = 0;
  for (const auto& face : mesh.faces) {
    const auto p = [&](std::size_t i) -> Eigen::Vector3d {
      return mesh.vertices[face[i]].position.cast<double>();
    };
    volume += p(0).dot(p(1).cross(p(2))) / 6;
  }
  return volume;
}

}  // namespace scantrove::test
