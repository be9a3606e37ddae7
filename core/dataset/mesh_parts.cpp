#include "core/dataset/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace scantrove {
namespace {

std::uint32_t regionOfFace(const LabeledMesh& mesh, const std::array<std::uint32_t, 3>& face) {
  const std::uint32_t a = mesh.vertices[face[0]].region, b = mesh.vertices[face[1]].region,
                      c = mesh.vertices[face[2]].region;
  return b == c ? b : a;
}

/// A mesh that collects faces of another one with their vertices.
struct Part {
  LabeledMesh mesh;
  std::unordered_map<std::uint32_t, std::uint32_t> taken;

  void add(const LabeledMesh& whole, const std::array<std::uint32_t, 3>& face) {
    std::array<std::uint32_t, 3> own{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [entry, is_new] =
          taken.try_emplace(face[i], static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(whole.vertices[face[i]]);
      own[i] = entry->second;
    }
    mesh.faces.push_back(own);
  }
};

}  // namespace

std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> facesByRegion(
    const LabeledMesh& mesh, std::span<const LabeledRegion> regions) {
  std::unordered_set<std::uint32_t> requested;
  for (const LabeledRegion& region : regions) requested.insert(region.id);
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> faces;
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const std::uint32_t region = regionOfFace(mesh, mesh.faces[face]);
    faces[requested.contains(region) ? region : 0].push_back(face);
  }
  return faces;
}

std::unordered_map<std::uint32_t, LabeledMesh> splitByRegion(const LabeledMesh& mesh,
                                                             std::span<const LabeledRegion> regions) {
  std::unordered_map<std::uint32_t, LabeledMesh> meshes;
  for (const auto& [region, faces] : facesByRegion(mesh, regions)) {
    Part part;
    for (const std::uint32_t face : faces) part.add(mesh, mesh.faces[face]);
    meshes.emplace(region, std::move(part.mesh));
  }
  return meshes;
}

LabeledMesh transformed(LabeledMesh mesh, const Eigen::Affine3f& T) {
  const Eigen::Matrix3f turn = T.rotation();
  for (SurfacePoint& vertex : mesh.vertices) {
    vertex.position_world_m = T * vertex.position_world_m;
    vertex.normal_world = turn * vertex.normal_world;
  }
  return mesh;
}

Eigen::AlignedBox3f boxOf(const LabeledMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const SurfacePoint& vertex : mesh.vertices) box.extend(vertex.position_world_m);
  return box;
}

float diameterOf(const LabeledMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // Farthest from the centre first: once the sum of two distances from it is below the maximum found, all
  // later pairs are shorter.
  const Eigen::Vector3f middle = boxOf(mesh).center();
  std::vector<std::pair<float, Eigen::Vector3f>> points;
  points.reserve(mesh.vertices.size());
  for (const SurfacePoint& vertex : mesh.vertices) {
    points.emplace_back((vertex.position_world_m - middle).norm(), vertex.position_world_m);
  }
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  float best = 0;
  for (std::size_t i = 0; i < points.size() && points[i].first + points.front().first > best; ++i) {
    for (std::size_t j = 0; j < i && points[i].first + points[j].first > best; ++j) {
      best = std::max(best, (points[i].second - points[j].second).norm());
    }
  }
  return best;
}

Result<void> checkMesh(const LabeledMesh& mesh) {
  const bool has_faces = std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) {
    return *std::max_element(face.begin(), face.end()) < mesh.vertices.size();
  });
  const bool is_finite = std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const SurfacePoint& p) {
    return p.position_world_m.allFinite() && p.normal_world.allFinite();
  });
  if (has_faces && is_finite) return {};
  return fail("The surface of the scan is damaged.", "Open the scan and make its surface anew.");
}

}  // namespace scantrove
