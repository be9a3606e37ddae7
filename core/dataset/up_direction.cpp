#include "core/dataset/up_direction.h"

#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr float kLeastLevelPart = 0.03F;  ///< of the vertices, for a surface to say what is level

/// The mean of the normals within `angle_deg` of `about`, and how many there are.
std::pair<Eigen::Vector3f, std::size_t> meanNormal(const LabelledMesh& mesh, const Eigen::Vector3f& about,
                                                   float angle_deg) {
  const float least = std::cos(angle_deg * std::numbers::pi_v<float> / 180);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  std::size_t count = 0;
  for (const SurfacePoint& vertex : mesh.vertices) {
    if (vertex.normal_world.dot(about) < least) continue;
    sum += vertex.normal_world;
    ++count;
  }
  return {sum, count};
}

}  // namespace

Eigen::Vector3f upDirection(std::span<const KeyFrameInfo> frames, const LabelledMesh& mesh) {
  if (frames.empty()) return Eigen::Vector3f::UnitZ();
  Eigen::Vector3d held = Eigen::Vector3d::Zero();
  for (const KeyFrameInfo& frame : frames) held -= frame.T_world_depth.linear().col(1);
  if (held.norm() < 1e-3) held = -frames.front().T_world_depth.linear().col(1);
  Eigen::Vector3f by_hand = held.normalized().cast<float>();
  // From all that could be level to what is: whatever surface has most of it wins.
  Eigen::Vector3f up = by_hand;
  for (const float angle_deg : {50.0F, 35.0F, 25.0F, 15.0F, 10.0F, 5.0F, 5.0F}) {
    const auto [sum, count] = meanNormal(mesh, up, angle_deg);
    const auto least = kLeastLevelPart * static_cast<float>(mesh.vertices.size());
    if (static_cast<float>(count) < std::max(1.0F, least) || sum.norm() < 1e-3F) return by_hand;
    up = sum.normalized();
  }
  return up;
}

Eigen::Affine3f turning(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  return Eigen::Affine3f(Eigen::Quaternionf::FromTwoVectors(from, to).normalized());
}

}  // namespace scantrove
