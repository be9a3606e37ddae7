#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/hash_random.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {
namespace {

constexpr double kWay_m = 60;
constexpr double kPace = 0.75;  // m/s
constexpr double kHalfWidth_m = 1.2;
constexpr double kBay_m = 1.5;     // distance of two things on one side
constexpr double kOverhang_m = 5;  // beyond both ends of the path, so that the view ahead is never empty

/// A corridor position and its random numbers in 0..1: `along` from its start, side -1 or 1.
struct Bay {
  SyntheticScene& scene;
  double along;
  int side;
  int number;
  std::uint32_t seed;

  [[nodiscard]] double draw(std::uint32_t what) const { return hashUniform(hashBits(what, seed, 5, 77)); }
  /// Distance from the bay's wall into the corridor.
  [[nodiscard]] double into(double distance) const { return side * (kHalfWidth_m - distance); }
  [[nodiscard]] std::string name(const std::string& thing) const {
    return thing + " " + std::to_string(number) + (side < 0 ? ", right" : ", left");
  }
  [[nodiscard]] std::uint32_t color(std::uint32_t what) const {
    constexpr std::uint32_t kColors[] = {0xa23b3b, 0x2b4c7e, 0x3f7f5f, 0xd9902f,
                                         0x6b4c8c, 0x3a7ca5, 0x8a5a35};
    return kColors[static_cast<std::size_t>(draw(what) * 6.99)];
  }
};

void addDoor(const Bay& bay) {
  const auto door = bay.scene.addInstance(bay.name("door"), false);
  const Material wood{Pattern::wood, rgb(bay.color(1)), {}, {}, 0.03F};
  addBox(bay.scene, door, {bay.along, bay.into(0.02), 0}, {0.9, 0.04, 2.02}, 0.002, wood);
  const Material frame{Pattern::plain, rgb(0xf1eee6)};
  for (const double edge : {-0.5, 0.5}) {
    addBox(bay.scene, door, {bay.along + edge, bay.into(0.04), 0}, {0.1, 0.08, 2.1}, 0.004, frame);
  }
}

void addPicture(const Bay& bay) {
  const Vec3 size{0.4 + 0.5 * bay.draw(1), 0.03, 0.3 + 0.4 * bay.draw(2)};
  addBox(bay.scene, bay.scene.addInstance(bay.name("picture"), false),
         {bay.along, bay.into(0.015), 1.1 + 0.3 * bay.draw(3), bay.side > 0 ? 0.0 : 180.0}, size, 0.004,
         {Pattern::picture, rgb(bay.color(4)), rgb(0x6f9a8d), rgb(bay.color(5)), 0.03F, 0, true, bay.seed});
}

void addPillar(const Bay& bay) {
  const double side_m = 0.2 + 0.15 * bay.draw(1);
  addBox(bay.scene, bay.scene.addInstance(bay.name("pillar"), false), {bay.along, bay.into(side_m / 2), 0},
         {side_m, side_m, 2.5}, 0.01, {Pattern::plaster, rgb(0xd8d2c4), {}, {}, 0.03F, 0, true, bay.seed});
}

void addCupboard(const Bay& bay) {
  const Vec3 size{0.5 + 0.5 * bay.draw(1), 0.3, 0.6 + 0.4 * bay.draw(2)};
  addBox(bay.scene, bay.scene.addInstance(bay.name("cupboard"), false), {bay.along, bay.into(0.16), 0}, size,
         0.006, {Pattern::wood, rgb(bay.color(3)), {}, {}, 0.03F, 0, true, bay.seed});
  const Place top{bay.along + 0.1, bay.into(0.17), size.z(), 40 * bay.draw(4)};
  const Material glaze{Pattern::speckle, rgb(bay.color(5)), rgb(0xdfe9ee), {}, 0.012F, 0.3F, true, bay.seed};
  if (bay.draw(6) < 0.5) {
    addVase(bay.scene, bay.name("vase"), top, glaze);
  } else {
    addBall(bay.scene, bay.name("globe"), top, 0.09, glaze);
  }
}

void addParcel(const Bay& bay) {
  const Vec3 size{0.3 + 0.2 * bay.draw(1), 0.25, 0.2 + 0.3 * bay.draw(2)};
  addCarton(bay.scene, bay.name("parcel"), {bay.along, bay.into(0.28), 0, 30 * bay.draw(3)}, size,
            {Pattern::boxLabel, rgb(bay.color(4)), rgb(0xa57c52), rgb(0xf3ead8), 0.03F, 0, true, bay.seed});
}

SyntheticScene makeCorridor() {
  SyntheticScene scene;
  const double length = kWay_m + 2 * kOverhang_m;
  const double middle = kWay_m / 2;
  addBox(scene, scene.addInstance("floor", false), {middle, 0, 0}, {length, 2 * kHalfWidth_m + 0.4, 0.1}, 0,
         {Pattern::tiles, rgb(0xcfc8bb), rgb(0x8f887c), {}, 0.3F}, {0, 0, -0.1});
  addWall(scene, "wall, left", {middle, kHalfWidth_m + 0.05, 0, 0}, length, 0xe6e1d6);
  addWall(scene, "wall, right", {middle, -kHalfWidth_m - 0.05, 0, 180}, length, 0x9fb8ad);
  addWall(scene, "wall, start", {-kOverhang_m, 0, 0, 90}, 2 * kHalfWidth_m, 0xe6e1d6);
  addWall(scene, "wall, end", {kWay_m + kOverhang_m, 0, 0, 270}, 2 * kHalfWidth_m, 0xe6e1d6);
  int number = 0;
  for (double along = 1 - kOverhang_m; along < kWay_m + kOverhang_m - 1; along += kBay_m) {
    ++number;
    for (const int side : {-1, 1}) {
      const auto seed = static_cast<std::uint32_t>(2 * number + (side > 0 ? 1 : 0));
      const Bay bay{scene, along + 0.25 * side, side, number, seed};
      constexpr void (*kThings[])(const Bay&) = {addDoor,   addPicture, addCupboard,
                                                 addPillar, addParcel,  addPicture};
      kThings[(static_cast<std::size_t>(number) + (side > 0 ? 3U : 0U)) % std::size(kThings)](bay);
    }
  }
  return scene;
}

/// Looks ahead and from side to side.
Gaze alongCorridor(double t) {
  const double x = std::min(kPace * t, kWay_m);
  const double yaw = 0.75 * std::sin(2 * std::numbers::pi * t / 14);
  const Vec3 eye{x, 0.15 * std::sin(2 * std::numbers::pi * t / 9), 1.4};
  return {eye, eye + Vec3(std::cos(yaw), std::sin(yaw), -0.3)};
}

}  // namespace

SceneRecipe makeCorridorScene() {
  return {.name = "corridor",
          .scene = makeCorridor(),
          .path = alongCorridor,
          .frames = static_cast<int>(kWay_m / kPace * 30),
          .lit_center = {kWay_m / 2, 0, 0.5},
          .lit_radius_m = kWay_m / 2 + kOverhang_m};
}

}  // namespace scantrove::synthetic
