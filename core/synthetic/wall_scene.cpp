#include <cmath>
#include <numbers>

#include "core/synthetic/furniture.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {
namespace {

constexpr double kWallY = 1.5;
constexpr double kPaint_m = 0.001;  // thinner than any camera sees

void paint(SyntheticScene& scene, const std::string& name, double x, double z, const Vec3& size,
           const Material& material) {
  addBox(scene, scene.addInstance(name, false), {x, kWallY - kPaint_m / 2, z}, {size.x(), kPaint_m, size.z()},
         0, material);
}

SyntheticScene makeWall() {
  SyntheticScene scene;
  addWall(scene, "wall", {0, kWallY + 0.05, 0, 0}, 6, 0xe6e1d6);
  const auto picture = [](std::uint32_t frame, std::uint32_t near, std::uint32_t far, std::uint32_t seed) {
    return Material{Pattern::picture, rgb(frame), rgb(near), rgb(far), 0.03F, 0, true, seed};
  };
  paint(scene, "poster, left", -1.0, 0.95, {0.6, 0, 0.8}, picture(0x6b4a2f, 0x6f9a8d, 0x3f6b57, 12));
  paint(scene, "poster", -0.15, 1.05, {0.7, 0, 0.5},
        {Pattern::weave, rgb(0xb5838d), rgb(0x6d6875), rgb(0xd8b4a0), 0.05F, 0, true, 3});
  paint(scene, "poster, right", 0.75, 0.9, {0.6, 0, 0.8},
        {Pattern::boxLabel, rgb(0xf2b632), rgb(0xc8402f), rgb(0xfff4d8), 0.03F, 0, true, 7});
  paint(scene, "note", 1.35, 1.35, {0.25, 0, 0.25},
        {Pattern::speckle, rgb(0xe0d6c3), rgb(0x7d6b58), {}, 0.02F, 0, true, 5});
  return scene;
}

Gaze alongWall(double t) {
  const double way = 2 * std::numbers::pi * t / 10;
  const double x = -0.75 * std::cos(way);
  return {{x, 0.1 + 0.15 * std::sin(2 * way), 1.2 + 0.1 * std::sin(way)},
          {x + 0.2 * std::sin(way), kWallY, 1.2 + 0.1 * std::cos(way)}};
}

}  // namespace

SceneRecipe makeWallScene() {
  return {.name = "wall",
          .scene = makeWall(),
          .path = alongWall,
          .frames = 300,
          .lit_center = {0, kWallY, 1.2},
          .lit_radius_m = 2};
}

}  // namespace scantrove::synthetic
