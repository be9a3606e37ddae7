#include "ui/scene/up_direction.h"

#include <array>
#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr std::size_t kMinNormals = 60;
constexpr float kSearchCone_deg = 50;

float cosine(float degrees) { return std::cos(degrees * std::numbers::pi_v<float> / 180); }

struct Vote {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weight = 0;
};

Vote votesNear(const std::vector<Eigen::Vector3f>& normals, const Eigen::Vector3f& axis, float degrees) {
  const float limit = cosine(degrees);
  Vote vote;
  for (const Eigen::Vector3f& normal : normals) {
    const float along = normal.dot(axis);
    if (!(std::abs(along) >= limit * normal.norm())) continue;
    vote.sum += along >= 0 ? normal : Eigen::Vector3f(-normal);
    vote.weight += normal.norm();
  }
  return vote;
}

}  // namespace

Eigen::Vector3f findUp(const std::vector<Eigen::Vector3f>& normals, const Eigen::Vector3f& first_guess) {
  if (normals.size() < kMinNormals) return first_guess;
  // A coarse look at directions around the guess, then mean shift with a narrowing cone.
  const Eigen::Vector3f side = first_guess.unitOrthogonal();
  const Eigen::Vector3f other = first_guess.cross(side);
  Eigen::Vector3f best = first_guess;
  float best_weight = votesNear(normals, first_guess, 12).weight;
  for (int ring = 1; ring <= 5; ++ring) {
    for (int step = 0; step < 16; ++step) {
      const float tilt = static_cast<float>(ring) * 10 * std::numbers::pi_v<float> / 180;
      const float turn = static_cast<float>(step) / 16 * 2 * std::numbers::pi_v<float>;
      const Eigen::Vector3f axis =
          std::cos(tilt) * first_guess + std::sin(tilt) * (std::cos(turn) * side + std::sin(turn) * other);
      const float weight = votesNear(normals, axis, 12).weight;
      if (weight > best_weight) {
        best_weight = weight;
        best = axis;
      }
    }
  }
  for (const float cone : std::array<float, 3>{12, 8, 6}) {
    const Vote vote = votesNear(normals, best, cone);
    if (!(vote.weight > 0)) break;
    best = vote.sum.normalized();
  }
  return best.dot(first_guess) >= cosine(kSearchCone_deg + 10) ? best : first_guess;
}

}  // namespace scantrove
