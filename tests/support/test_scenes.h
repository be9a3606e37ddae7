#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::test {

/// An L-shaped block ("L block") in the middle of a table, with other objects at a distance. The first frames
/// show it from the front: a foot and an upright that meet in a concave edge. Later frames show the L-shaped
/// side, which connects both over rounded convex edges.
inline synthetic::SceneRecipe makeLBlockScene() {
  using namespace synthetic;
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {5, 5, 0.1}, 0, {Pattern::tiles, rgb(0xcfc8bb), rgb(0x8f887c), {}, 0.3F},
         {0, 0, -0.1});
  addTable(scene, {}, {1.1, 1.1, 0.70}, {Pattern::wood, rgb(0xc79a66)});
  addLBlock(scene, "L block", {0, 0, 0.70, 0}, {0.26, 0.20, 0.22}, 0.08, 0.02,
            {Pattern::wood, rgb(0x7fb069), {}, {}, 0.03F});
  // Objects at a distance: a bare table top would not constrain the camera.
  addWall(scene, "wall, back", {-2.0, 0, 0, 90}, 4.4, 0xe6e1d6);
  addWall(scene, "wall, left", {0, -2.2, 0, 180}, 4.0, 0x9fb8ad);
  addCarton(scene, "carton", {-0.40, -0.34, 0.70, 25}, {0.17, 0.07, 0.24},
            {Pattern::boxLabel, rgb(0xf2b632), rgb(0xc8402f), rgb(0xfff4d8), 0.03F, 0.05F, true, 3});
  addVase(scene, "vase", {-0.42, 0.26, 0.70},
          {Pattern::bands, rgb(0x2f6f8f), rgb(0xe8eef0), {}, 0.032F, 0.35F});
  addBowl(scene, "bowl", {0.10, -0.42, 0.70},
          {Pattern::bands, rgb(0xd97b4a), rgb(0xf0d9b8), {}, 0.022F, 0.35F});
  addBall(scene, "ball", {-0.14, 0.44, 0.70}, 0.06,
          {Pattern::stripes, rgb(0xd7263d), rgb(0xf5f1e8), {}, 0.0628F, 0.3F});
  const auto path = [](double t) -> Gaze {
    // From the front for half a second, then to the side, then back.
    const double turned = 42 * (1 - std::cos(std::clamp(t - 0.5, 0.0, 1e9) * 2 * std::numbers::pi / 15));
    const double azimuth = turned * (std::numbers::pi / 180);
    return {{0.64 * std::cos(azimuth), 0.64 * std::sin(azimuth), 1.14}, {0, 0, 0.78}};
  };
  return {.name = "l_block",
          .scene = std::move(scene),
          .path = path,
          .frames = 150,
          .lit_center = {0, 0, 0.4},
          .lit_radius_m = 1.5};
}

/// Floor, walls, a parcel, a basket, and a chair ("chair") that splits the floor in the first frames. Later
/// frames show the floor around it in one piece.
inline synthetic::SceneRecipe makeChairFloorScene() {
  using namespace synthetic;
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {4.8, 4.6, 0.1}, 0, {Pattern::planks, rgb(0xb68a5e), {}, {}, 0.13F}, {0, 0, -0.1});
  addWall(scene, "wall, back", {0, 1.55, 0, 0}, 4.8, 0xe6e1d6);
  addWall(scene, "wall, right", {2.35, 0, 0, 90}, 3.0, 0x9fb8ad);
  addChair(scene, "chair", {0.0, 0.0, 0, 8}, {Pattern::wood, rgb(0x8a5a35)},
           {Pattern::weave, rgb(0x3c7a89), rgb(0x2e5f6b), rgb(0x4f93a3), 0.02F});
  addCarton(scene, "parcel", {1.05, 1.05, 0, 25}, {0.36, 0.28, 0.34},
            {Pattern::boxLabel, rgb(0xc69c6d), rgb(0xa57c52), rgb(0xf3ead8), 0.03F, 0, true, 21});
  addBasket(scene, "basket", {-0.80, 1.15, 0, 0},
            {Pattern::checker, rgb(0xc9a36b), rgb(0xa67c45), {}, 0.03F});
  const auto path = [](double t) -> Gaze {
    static const Gaze kWay[] = {
        {{0.10, -1.00, 1.18}, {0.02, 0.25, 0.55}}, {{-0.10, -1.20, 1.30}, {0.0, 0.2, 0.44}},
        {{-0.45, -1.30, 1.40}, {0.0, 0.1, 0.34}},  {{-0.85, -1.10, 1.46}, {0.0, 0.0, 0.28}},
        {{-1.15, -0.75, 1.46}, {0.0, 0.0, 0.28}},
    };
    return alongSpline(kWay, 1.25, t);
  };
  return {.name = "chair_floor",
          .scene = std::move(scene),
          .path = path,
          .frames = 150,
          .lit_center = {0, 0.8, 0.4},
          .lit_radius_m = 2};
}

/// Seven books ("book 0" ... "book 6") in a row on a table, 2.5 to 4.5 cm thick, spines towards the camera,
/// which moves along them at 1 m.
inline synthetic::SceneRecipe makeBookRowScene() {
  using namespace synthetic;
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {5, 5, 0.1}, 0, {Pattern::tiles, rgb(0xcfc8bb), rgb(0x8f887c), {}, 0.3F},
         {0, 0, -0.1});
  addTable(scene, {}, {1.4, 0.8, 0.70}, {Pattern::wood, rgb(0xc79a66)});
  addWall(scene, "wall, back", {0, 0.9, 0, 0}, 4.4, 0xe6e1d6);
  const std::uint32_t covers[] = {0xa23b3b, 0x2b4c7e, 0x3f7f5f, 0xd9902f, 0x6b4c8c, 0x1f5f6b, 0x8c2f39};
  double x = -0.13;
  for (int i = 0; i < 7; ++i) {
    const double thickness = 0.025 + 0.005 * (3 * i % 5);
    const double height = 0.19 + 0.015 * (2 * i % 5), depth = 0.13 + 0.008 * (i % 4);
    addBook(scene, "book " + std::to_string(i),
            {x + thickness / 2, -0.10 + 0.006 * (3 * i % 5) + depth / 2, 0.70}, {depth, height, thickness},
            {Pattern::bookCover, rgb(covers[i]), rgb(0xf1e4c8), rgb(0x8fc1b5), 0.03F, 0, true,
             static_cast<std::uint32_t>(i) + 1},
            true);
    x += thickness + 0.001;
  }
  addCarton(scene, "carton", {-0.45, 0.05, 0.70, 25}, {0.17, 0.07, 0.24},
            {Pattern::boxLabel, rgb(0xf2b632), rgb(0xc8402f), rgb(0xfff4d8), 0.03F, 0.05F, true, 3});
  addVase(scene, "vase", {0.42, 0.02, 0.70},
          {Pattern::bands, rgb(0x2f6f8f), rgb(0xe8eef0), {}, 0.032F, 0.35F});
  const auto path = [](double t) -> Gaze {
    const double along = 0.45 * std::sin(t * 2 * std::numbers::pi / 8);
    return {{along, -1.0, 1.15}, {0.1 * along, 0, 0.78}};
  };
  return {.name = "book_row",
          .scene = std::move(scene),
          .path = path,
          .frames = 90,
          .lit_center = {0, 0, 0.7},
          .lit_radius_m = 1.5};
}

}  // namespace scantrove::test
