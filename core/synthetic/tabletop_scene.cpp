#include <cmath>
#include <numbers>

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Gaze aroundTable(double t) {
  const double azimuth = (-100 + 15.5 * t) * kDegree;
  const double radius = 0.87 + 0.05 * std::sin(0.9 * t);
  const double height = 1.27 + 0.10 * std::sin(0.55 * t + 0.5);
  return {{radius * std::cos(azimuth), radius * std::sin(azimuth), height},
          {0.03 * std::sin(0.7 * t), 0.03 * std::cos(0.5 * t), 0.76}};
}

SyntheticScene makeTabletop() {
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {5, 5, 0.1}, 0, {Pattern::planks, rgb(0xb08a63), {}, {}, 0.14F}, {0, 0, -0.1});
  addWall(scene, "wall, back", {0, 2.45, 0, 0}, 5, 0xdfe5e1);
  addWall(scene, "wall, right", {2.45, 0, 0, 90}, 4.8, 0xe9e0d2);
  addWall(scene, "wall, front", {0, -2.45, 0, 180}, 5, 0xdfe5e1);
  addWall(scene, "wall, left", {-2.45, 0, 0, 270}, 4.8, 0xb9cdd2);
  addBox(scene, scene.addInstance("rug", false), {}, {2.4, 1.8, 0.012}, 0.004,
         {Pattern::weave, rgb(0x5d7a8c), rgb(0xd9c9a8), rgb(0x4a6274), 0.09F});
  addTable(scene, {}, {1.25, 0.90, 0.72}, {Pattern::wood, rgb(0xd9b488)});

  const double z = 0.72;
  addLamp(scene, "lamp", {-0.44, 0.26, z}, {Pattern::plain, rgb(0xf2e3c2)});
  Material vase{Pattern::bands, rgb(0x2f6f8f), rgb(0xe8eef0), {}, 0.032F, 0.35F};
  addVase(scene, "vase", {-0.20, 0.30, z}, vase);
  addCarton(scene, "cereal box", {0.07, 0.29, z, 12}, {0.17, 0.06, 0.25},
            {Pattern::boxLabel, rgb(0xf2b632), rgb(0xc8402f), rgb(0xfff4d8), 0.03F, 0.05F, true, 3});
  addBottle(scene, "bottle", {0.34, 0.28, z},
            {Pattern::canLabel, rgb(0x2f7d4f), rgb(0xe6dfb0), rgb(0x1d4a33), 0.03F, 0.5F});
  addBook(scene, "book, lower", {-0.42, -0.02, z, 15}, {0.16, 0.22, 0.034},
          {Pattern::bookCover, rgb(0x8c2f39), rgb(0xe9d8a6), rgb(0xd98f5c), 0.03F, 0, true, 5});
  addBook(scene, "book, upper", {-0.41, -0.01, z + 0.034, 52}, {0.13, 0.19, 0.025},
          {Pattern::bookCover, rgb(0x1f5f6b), rgb(0xf1e4c8), rgb(0x8fc1b5), 0.03F, 0, true, 9});
  addTeapot(scene, "teapot", {-0.14, 0.05, z, 25},
            {Pattern::dots, rgb(0xf0f0ea), rgb(0xb5475b), {}, 0.034F, 0.5F});
  addBowl(scene, "bowl", {0.16, 0.06, z}, {Pattern::bands, rgb(0xd97b4a), rgb(0xf0d9b8), {}, 0.022F, 0.35F});
  addCactus(scene, "cactus", {0.46, 0.09, z, -30});
  addMug(scene, "mug", {-0.46, -0.28, z, -35},
         {Pattern::stripes, rgb(0x3567a8), rgb(0xf1f1ee), {}, 0.0220F, 0.45F});
  addRing(scene, "toy ring", {-0.22, -0.25, z},
          {Pattern::stripes, rgb(0xe94f64), rgb(0xf9c846), {}, 0.0487F, 0.2F});
  addLBlock(scene, "L block", {0.03, -0.22, z, -60}, {0.15, 0.085, 0.13}, 0.045, 0.005,
            {Pattern::wood, rgb(0x7fb069), {}, {}, 0.03F});
  addCan(scene, "can", {0.24, -0.19, z, 40},
         {Pattern::canLabel, rgb(0xc9372c), rgb(0xf3ead3), rgb(0xf2a541), 0.03F, 0.25F});
  addArch(scene, "toy arch", {0.45, -0.24, z, 50},
          {Pattern::bands, rgb(0x8e6bbf), rgb(0xc9b6e4), {}, 0.0262F});
  addBall(scene, "ball", {0.30, -0.34, z}, 0.045,
          {Pattern::stripes, rgb(0xf7a823), rgb(0x2a9d8f), {}, 0.0471F, 0.3F});
  addCarton(scene, "toy block", {-0.03, -0.37, z, 20}, {0.06, 0.06, 0.06},
            {Pattern::checker, rgb(0x4f7cac), rgb(0xe8e9eb), {}, 0.02F});
  addCarton(scene, "toy block, upper", {-0.028, -0.368, z + 0.06, 48}, {0.045, 0.045, 0.045},
            {Pattern::dots, rgb(0xe56b6f), rgb(0xfff3e2), {}, 0.0225F});
  return scene;
}

}  // namespace

SceneRecipe makeTabletopScene() {
  return {.name = "tabletop",
          .scene = makeTabletop(),
          .path = aroundTable,
          .frames = 300,
          .lit_center = {0, 0, 0.4},
          .lit_radius_m = 1.5};
}

}  // namespace scantrove::synthetic
