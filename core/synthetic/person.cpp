#include "core/synthetic/person.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

constexpr double kStride_m = 0.7;                         // from one footfall to the next
constexpr double kSwing = 24.0 / 180 * std::numbers::pi;  // amplitude of a leg
constexpr double kArmRise_deg = 20;

Material skinOf(HashStream& random) {
  return {Pattern::plain, random.pick({rgb(0xe0b08c), rgb(0x8d5a3b), rgb(0xc68a62)}), {}, {}, 0.03F, 0,
          false};
}

Material clothOf(HashStream& random) {
  Material cloth{Pattern::stripes, randomColor(random)};
  cloth.second = cloth.main * 0.8F;
  cloth.casts_shadow = false;
  return cloth;
}

/// Rotation about the y axis through `pivot`.
Eigen::Isometry3d swing(double angle, const Vec3& pivot) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(pivot);
  T.rotate(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  T.translate(-pivot);
  return T;
}

/// Adds a rod with round ends between two points of the object's frame.
void addCapsule(SyntheticScene& scene, std::uint16_t id, const Place& place, const Vec3& from, const Vec3& to,
                double radius, const Material& material) {
  const Vec3 along = to - from;
  Lathe::Profile profile;
  appendArc(profile, {0, 0}, radius, -90, 0, 5);
  appendArc(profile, {0, along.norm()}, radius, 0, 90, 5);
  addPart(scene, id, place, std::make_unique<Lathe>(profile), material, from,
          Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), along).toRotationMatrix());
}

}  // namespace

Vec3 alongWaypoints(const std::vector<Waypoint>& way, double time_s) {
  const auto next = std::ranges::find_if(way, [&](const Waypoint& w) { return w.time_s > time_s; });
  if (next == way.begin()) return way.front().at;
  if (next == way.end()) return way.back().at;
  const Waypoint& last = *std::prev(next);
  const double part = (time_s - last.time_s) / (next->time_s - last.time_s);
  return last.at + part * part * (3 - 2 * part) * (next->at - last.at);
}

void addPerson(HashStream& random, SceneRecipe& recipe, double y, std::vector<Waypoint> way) {
  SyntheticScene& scene = recipe.scene;
  const auto id = scene.addInstance("person", false, true);
  const Material skin = skinOf(random);
  const Material shirt = clothOf(random);
  const Material trousers = clothOf(random);
  const double tall = random.uniform(0.92, 1.08);
  const Place place{0, y, 0, 0};
  const auto add = [&](const Vec3& half, const Vec3& center, const Material& material) {
    addPart(scene, id, place, std::make_unique<RoundedBox>(half * tall, 0.9 * tall * half.minCoeff()),
            material, center * tall);
  };
  const auto moves = [&](std::size_t first, double phase, const Vec3& joint) {
    recipe.animated_parts.push_back(
        {first, scene.parts().size() - first, [way, phase, pivot = joint](double time_s) {
           const Vec3 at = alongWaypoints(way, time_s);
           const double angle = kSwing * std::sin(at.x() / kStride_m * std::numbers::pi + phase);
           return Eigen::Isometry3d(Eigen::Translation3d(at) * swing(angle, pivot));
         }});
  };
  std::size_t first = scene.parts().size();
  add({0.115, 0.20, 0.32}, {0, 0, 1.13}, shirt);
  addPart(scene, id, place, std::make_unique<Sphere>(0.105 * tall), skin, {0, 0, 1.58 * tall});
  recipe.animated_parts.push_back({first, 2, [way](double time_s) {
                                     return Eigen::Isometry3d(
                                         Eigen::Translation3d(alongWaypoints(way, time_s)));
                                   }});
  for (const double side : {-1.0, 1.0}) {
    const double phase = side > 0 ? 0 : std::numbers::pi;
    first = scene.parts().size();
    add({0.07, 0.08, 0.43}, {0, 0.1 * side, 0.44}, trousers);
    moves(first, phase, Vec3(0, y, 0.86 * tall));
    first = scene.parts().size();
    add({0.045, 0.045, 0.30}, {0, 0.235 * side, 1.10}, shirt);
    add({0.04, 0.035, 0.05}, {0, 0.235 * side, 0.76}, skin);
    moves(first, phase + std::numbers::pi, Vec3(0, y, 1.40 * tall));
  }
}

void addArm(HashStream& random, SceneRecipe& recipe, double from, std::vector<Waypoint> way) {
  SyntheticScene& scene = recipe.scene;
  const auto id = scene.addInstance("arm", false, true);
  const std::size_t first = scene.parts().size();
  addPart(scene, id, {}, std::make_unique<Sphere>(0.045), skinOf(random));
  const double rise = kArmRise_deg / 180 * std::numbers::pi;
  const Vec3 backwards(from * std::cos(rise), 0, std::sin(rise));
  addPart(scene, id, {}, std::make_unique<RoundedBox>(Vec3(0.6, 0.04, 0.04), 0.035), clothOf(random),
          0.62 * backwards, turned(-from * kArmRise_deg, Vec3::UnitY()));
  recipe.animated_parts.push_back({first, 2, [way = std::move(way)](double time_s) {
                                     return Eigen::Isometry3d(
                                         Eigen::Translation3d(alongWaypoints(way, time_s)));
                                   }});
}

void addHand(HashStream& random, SceneRecipe& recipe, const HandMotion& motion) {
  SyntheticScene& scene = recipe.scene;
  const auto id = scene.addInstance(motion.name, false, true);
  const Material skin = skinOf(random);
  const Material sleeve = clothOf(random);
  const Place place{0, 0, 0, motion.yaw_deg};
  // `outwards`: 1 for parts that move with the fingers, -1 with the thumb, 0 with the palm.
  const auto moves = [&](std::size_t first, double outwards) {
    const Vec3 opens = turned(motion.yaw_deg, Vec3::UnitZ()) * Vec3(outwards * motion.side, 0, 0);
    recipe.animated_parts.push_back({first, scene.parts().size() - first,
                                     [way = motion.way, opening = motion.opening, opens](double time_s) {
                                       const Vec3 at = alongWaypoints(way, time_s) +
                                                       alongWaypoints(opening, time_s).x() * opens;
                                       return Eigen::Isometry3d(Eigen::Translation3d(at));
                                     }});
  };
  std::size_t first = scene.parts().size();
  addPart(scene, id, place, std::make_unique<RoundedBox>(Vec3(0.042, 0.048, 0.014), 0.013), skin,
          {0, -0.065, 0.078});
  addCapsule(scene, id, place, {0, -0.10, 0.082}, {0, -0.18, 0.10}, 0.026, skin);
  addCapsule(scene, id, place, {0, -0.17, 0.10}, {0, -0.62, 0.24}, 0.042, sleeve);
  moves(first, 0);
  first = scene.parts().size();
  for (int i = 0; i < 4; ++i) {
    const double y = (i - 1.5) * 0.018;
    addCapsule(scene, id, place, {motion.side * kFingerRadius_m, y, 0},
               {motion.side * 0.03, 0.9 * y - 0.03, 0.07}, kFingerRadius_m, skin);
  }
  moves(first, 1);
  first = scene.parts().size();
  addCapsule(scene, id, place, {-motion.side * kFingerRadius_m, 0, 0}, {-motion.side * 0.035, -0.07, 0.06},
             kFingerRadius_m + 0.001, skin);
  moves(first, -1);
}

}  // namespace scantrove::synthetic
