#include "ui/scene/up_direction.h"

#include <array>
#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr std::size_t kMinNormals = 60;
// Range of orientations of a hand-held sensor. It excludes the walls, whose normals would need a sensor that
// looks up.
constexpr int kMaxUpward_deg = -4;
constexpr int kMaxDownward_deg = 74;
constexpr int kMaxRoll_deg = 24;
constexpr int kStep_deg = 6;

float radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

struct Vote {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weight = 0;
};

Vote votesNear(const std::vector<Eigen::Vector3f>& normals, const Eigen::Vector3f& axis, float degrees) {
  const float limit = std::cos(radians(degrees));
  Vote vote;
  for (const Eigen::Vector3f& normal : normals) {
    const float along = normal.dot(axis);
    if (!(std::abs(along) >= limit * normal.norm())) continue;
    vote.sum += along >= 0 ? normal : Eigen::Vector3f(-normal);
    vote.weight += normal.norm();
  }
  return vote;
}

/// Up in camera coordinates for a sensor that looks `pitch` below the horizon and is rolled by `roll`.
Eigen::Vector3f upOf(float pitch, float roll) {
  return {std::sin(roll), -std::cos(roll) * std::cos(pitch), -std::cos(roll) * std::sin(pitch)};
}

}  // namespace

Eigen::Vector3f findUp(const std::vector<Eigen::Vector3f>& normals, const Eigen::Matrix3f& R_world_camera) {
  Eigen::Vector3f best = -R_world_camera.col(1);
  if (normals.size() < kMinNormals) return best;
  float best_weight = 0;
  for (int pitch = kMaxUpward_deg; pitch <= kMaxDownward_deg; pitch += kStep_deg) {
    for (int roll = -kMaxRoll_deg; roll <= kMaxRoll_deg; roll += kStep_deg) {
      const Eigen::Vector3f axis =
          R_world_camera * upOf(radians(static_cast<float>(pitch)), radians(static_cast<float>(roll)));
      const float weight = votesNear(normals, axis, 8).weight;
      if (weight > best_weight) {
        best_weight = weight;
        best = axis;
      }
    }
  }
  for (const float cone : std::array<float, 3>{10, 8, 6}) {
    const Vote vote = votesNear(normals, best, cone);
    if (!(vote.weight > 0)) break;
    best = vote.sum.normalized();
  }
  return best;
}

}  // namespace scantrove
