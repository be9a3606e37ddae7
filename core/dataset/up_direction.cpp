#include "core/dataset/up_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace scantrove {
namespace {

constexpr float kMinLevelPart = 0.03F;  ///< of the vertices, for a surface to define the level
/// Maximum deviation of normals of a level surface seen once, due to a depth camera's noise.
constexpr float kLevel_deg = 15;
/// Users look down on things while scanning: weight of that against the area of a surface.
constexpr float kLookingDown = 3;
/// Most cameras are held upright: factor by which another roll must be better.
constexpr float kUsualRoll = 1.5F;
/// If a camera looks down more steeply, its roll does not tell the up direction.
constexpr float kSteepest_deg = 50;

float cosineOf(float angle_deg) { return std::cos(angle_deg * std::numbers::pi_v<float> / 180); }

/// The mean of the normals within `angle_deg` of `about`, and their number.
std::pair<Eigen::Vector3f, std::size_t> meanNormal(const LabeledMesh& mesh, const Eigen::Vector3f& about,
                                                   float angle_deg) {
  const float least = cosineOf(angle_deg);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  std::size_t count = 0;
  for (const SurfacePoint& vertex : mesh.vertices) {
    if (vertex.normal_world.dot(about) < least) continue;
    sum += vertex.normal_world;
    ++count;
  }
  return {sum, count};
}

/// The best level direction among all candidates: that of the surface with most vertices. None: there is no
/// such surface.
std::optional<Eigen::Vector3f> squareToLevel(const LabeledMesh& mesh, const Eigen::Vector3f& by_hand) {
  Eigen::Vector3f up = by_hand;
  for (const float angle_deg : {kSteepest_deg, 35.0F, 25.0F, kLevel_deg, 10.0F, 5.0F, 5.0F}) {
    const auto [sum, count] = meanNormal(mesh, up, angle_deg);
    const auto least = kMinLevelPart * static_cast<float>(mesh.vertices.size());
    if (static_cast<float>(count) < std::max(1.0F, least) || sum.norm() < 1e-3F) {
      if (angle_deg >= kLevel_deg) return std::nullopt;
      break;
    }
    up = sum.normalized();
  }
  if (up.dot(by_hand) < cosineOf(kSteepest_deg)) return std::nullopt;
  return up;
}

/// One of the four ways to hold a camera, over all frames.
struct Roll {
  Eigen::Vector3f by_hand = Eigen::Vector3f::Zero();  ///< the up direction if it was held so
  float agreement = 0;                                ///< of the frames: 1 = all the same
};

/// Upright first, then rotated by 90 degrees each.
std::array<Roll, 4> rollsOf(std::span<const KeyFrameInfo> frames) {
  Eigen::Vector3d right = Eigen::Vector3d::Zero(), down = Eigen::Vector3d::Zero();
  for (const KeyFrameInfo& frame : frames) {
    right += frame.T_world_depth.linear().col(0);
    down += frame.T_world_depth.linear().col(1);
  }
  const auto rollOf = [&](const Eigen::Vector3d& sum) {
    const double length = sum.norm() / static_cast<double>(frames.size());
    if (length < 1e-3) return Roll{};
    return Roll{sum.normalized().cast<float>(), static_cast<float>(length)};
  };
  return {rollOf(-down), rollOf(right), rollOf(down), rollOf(-right)};
}

Eigen::Vector3f meanForward(std::span<const KeyFrameInfo> frames) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const KeyFrameInfo& frame : frames) sum += frame.T_world_depth.linear().col(2);
  return (sum / static_cast<double>(frames.size())).cast<float>();
}

/// The score of `up`: area facing up, less area facing down like ceilings; more if the cameras look down on
/// it and have it up in their images.
float evidenceFor(const Eigen::Vector3f& up, const LabeledMesh& mesh, const Eigen::Vector3f& forward,
                  const Roll& roll) {
  const auto facing = static_cast<float>(meanNormal(mesh, up, kLevel_deg).second);
  const auto facing_away = static_cast<float>(meanNormal(mesh, -up, kLevel_deg).second);
  const float area = std::max(0.0F, facing - facing_away) / static_cast<float>(mesh.vertices.size());
  const float in_image = up.dot(roll.by_hand);
  return roll.agreement * in_image * in_image * area * (1 + kLookingDown * std::max(0.0F, -forward.dot(up)));
}

}  // namespace

Eigen::Vector3f upDirection(std::span<const KeyFrameInfo> frames, const LabeledMesh& mesh) {
  if (frames.empty()) return Eigen::Vector3f::UnitZ();
  const std::array<Roll, 4> rolls = rollsOf(frames);
  const Eigen::Vector3f forward = meanForward(frames);
  std::optional<Eigen::Vector3f> best;
  float most = 0;
  for (std::size_t i = 0; i < rolls.size(); ++i) {
    if (rolls[i].agreement == 0) continue;
    const auto up = squareToLevel(mesh, rolls[i].by_hand);
    if (!up) continue;
    const float evidence = (i == 0 ? kUsualRoll : 1) * evidenceFor(*up, mesh, forward, rolls[i]);
    if (evidence <= most) continue;
    most = evidence;
    best = up;
  }
  if (best) return *best;
  if (rolls[0].agreement > 0) return rolls[0].by_hand;
  return (-frames.front().T_world_depth.linear().col(1)).cast<float>();
}

Eigen::Affine3f turning(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  return Eigen::Affine3f(Eigen::Quaternionf::FromTwoVectors(from, to).normalized());
}

}  // namespace scantrove
