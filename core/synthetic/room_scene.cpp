#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {
namespace {

Gaze throughRoom(double t) {
  static const Gaze kPath[] = {
      {{0.62, -0.92, 1.18}, {0.50, 0.30, 0.55}},  {{0.40, -1.12, 1.30}, {0.42, 0.22, 0.46}},
      {{0.02, -1.25, 1.40}, {0.30, 0.12, 0.36}},  {{-0.42, -1.05, 1.44}, {0.16, 0.22, 0.36}},
      {{-0.80, -0.68, 1.44}, {0.02, 0.48, 0.48}}, {{-1.02, -0.22, 1.42}, {-0.16, 0.85, 0.66}},
      {{-1.00, 0.22, 1.38}, {-0.32, 1.22, 0.78}}, {{-0.68, 0.40, 1.33}, {-0.32, 1.36, 0.80}},
      {{-0.26, 0.44, 1.33}, {-0.22, 1.38, 0.80}}, {{0.16, 0.44, 1.36}, {-0.12, 1.38, 0.80}},
      {{0.52, 0.50, 1.38}, {-0.06, 1.36, 0.80}},
  };
  return alongSpline(kPath, 1.33, t);
}

/// Two mugs and three books that differ only in position: a user who names one is offered the others.
void addEquals(SyntheticScene& scene, double z) {
  const Material glaze{Pattern::bands, rgb(0xe4572e), rgb(0xfbf0e0), {}, 0.024F, 0.45F};
  addMug(scene, "mug", {-0.50, 1.08, z, -60}, glaze);
  addMug(scene, "mug, equal", {-0.06, 1.24, z, -75}, glaze);
  const Material cover{Pattern::bookCover, rgb(0xc2571a), rgb(0xf7ead2), rgb(0x2f6f73), 0.03F, 0, true, 5};
  const Vec3 pocket{0.12, 0.17, 0.04};
  addBook(scene, "pocket book", {-0.58, 1.33, z, 8}, pocket, cover);
  addBook(scene, "pocket book, second", {-0.40, 1.60, z, -4}, pocket, cover);
  addBook(scene, "pocket book, third", {0.28, 1.36, z, 14}, pocket, cover);
}

void addThingsOnTable(SyntheticScene& scene, double z) {
  addLamp(scene, "lamp", {-0.84, 1.60, z}, {Pattern::bands, rgb(0xf5dfa6), rgb(0xe9c46a), {}, 0.03F});
  addBook(scene, "book, red", {-0.575, 1.60, z}, {0.15, 0.22, 0.032},
          {Pattern::bookCover, rgb(0xa23b3b), rgb(0xf1dfb5), rgb(0xd58c5a), 0.03F, 0, true, 1}, true);
  addBook(scene, "book, blue", {-0.538, 1.605, z}, {0.17, 0.25, 0.040},
          {Pattern::bookCover, rgb(0x2b4c7e), rgb(0xe8e3d3), rgb(0x8fb3d9), 0.03F, 0, true, 2}, true);
  addBook(scene, "book, green", {-0.502, 1.595, z}, {0.14, 0.20, 0.028},
          {Pattern::bookCover, rgb(0x3f7f5f), rgb(0xf2e9cf), rgb(0xb7d3a8), 0.03F, 0, true, 3}, true);
  addVase(scene, "vase", {-0.27, 1.60, z}, {Pattern::bands, rgb(0x9c4f6c), rgb(0xf0d9df), {}, 0.04F, 0.35F});
  addCarton(scene, "tea box", {0.02, 1.62, z, -8}, {0.15, 0.08, 0.19},
            {Pattern::boxLabel, rgb(0x5aa9a3), rgb(0x24565b), rgb(0xfbf3dd), 0.03F, 0.05F, true, 8});
  addCactus(scene, "cactus", {0.37, 1.58, z, 150});
  addTeapot(scene, "teapot", {-0.82, 1.34, z, -30},
            {Pattern::speckle, rgb(0x3d6b8a), rgb(0xdfe9ee), {}, 0.012F, 0.5F});
  addBowl(scene, "bowl", {-0.26, 1.32, z}, {Pattern::bands, rgb(0x4f9d69), rgb(0xe9edc9), {}, 0.03F, 0.35F});
  addCan(scene, "can", {0.02, 1.37, z},
         {Pattern::canLabel, rgb(0x285ea8), rgb(0xf6f1de), rgb(0xe9a23b), 0.03F, 0.25F});
  addBottle(scene, "bottle", {0.20, 1.61, z},
            {Pattern::canLabel, rgb(0x7a4a21), rgb(0xf2e2b6), rgb(0x49290f), 0.03F, 0.5F});
  addEquals(scene, z);
  addRing(scene, "toy ring", {-0.78, 1.10, z},
          {Pattern::stripes, rgb(0x3fa7d6), rgb(0xfac05e), {}, 0.0487F, 0.2F});
  addLBlock(scene, "L block", {-0.18, 1.08, z, -120}, {0.15, 0.085, 0.13}, 0.045, 0.005,
            {Pattern::wood, rgb(0xd68c45), {}, {}, 0.03F});
  addBook(scene, "book, lower", {0.12, 1.12, z, -12}, {0.16, 0.22, 0.034},
          {Pattern::bookCover, rgb(0x6b4c8c), rgb(0xf0e6ef), rgb(0xc9a7d8), 0.03F, 0, true, 4});
  addCarton(scene, "matchbox", {0.13, 1.13, z + 0.034, 30}, {0.11, 0.07, 0.04},
            {Pattern::boxLabel, rgb(0xf2d03b), rgb(0xb23a2e), rgb(0xfdf6e3), 0.03F, 0, true, 6});
  addBall(scene, "ball", {0.36, 1.14, z}, 0.06,
          {Pattern::stripes, rgb(0xd7263d), rgb(0xf5f1e8), {}, 0.0628F, 0.3F});
}

SyntheticScene makeRoom() {
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {4.8, 4.6, 0.1}, 0, {Pattern::planks, rgb(0xb68a5e), {}, {}, 0.13F}, {0, 0, -0.1});
  addWall(scene, "wall, back", {0, 2.25, 0, 0}, 4.8, 0xe6e1d6);
  addWall(scene, "wall, left", {-2.35, 0, 0, 270}, 4.4, 0x9fb8ad);
  addWall(scene, "wall, right", {2.35, 0, 0, 90}, 4.4, 0xe6e1d6);
  addTable(scene, {-0.25, 1.38, 0, 0}, {1.50, 0.84, 0.74}, {Pattern::wood, rgb(0xc79a66)});
  addShelf(scene, "shelf", {1.45, 1.98, 0, 0}, {0.90, 0.34, 1.10}, {Pattern::plain, rgb(0xf1eee6)});
  addBox(scene, scene.addInstance("picture", false), {-0.35, 2.185, 1.25}, {0.9, 0.03, 0.62}, 0.004,
         {Pattern::picture, rgb(0x6b4a2f), rgb(0x6f9a8d), rgb(0x3f6b57), 0.03F, 0, true, 12});

  addChair(scene, "chair", {0.55, 0.00, 0, 12}, {Pattern::wood, rgb(0x8a5a35)},
           {Pattern::weave, rgb(0x3c7a89), rgb(0x2e5f6b), rgb(0x4f93a3), 0.02F});
  addStool(scene, "stool", {1.30, 0.85, 0, 0}, {Pattern::wood, rgb(0xe0b97f), rgb(0xf0efe9), {}, 0.03F});
  addBasket(scene, "basket", {-1.45, 1.65, 0, 0},
            {Pattern::checker, rgb(0xc9a36b), rgb(0xa67c45), {}, 0.03F});
  addCarton(scene, "parcel", {-1.55, 0.55, 0, 25}, {0.36, 0.28, 0.24},
            {Pattern::boxLabel, rgb(0xc69c6d), rgb(0xa57c52), rgb(0xf3ead8), 0.03F, 0, true, 21});
  addThingsOnTable(scene, 0.74);

  const double shelf_top = 1.10;
  const double shelf_middle = 0.561;
  addVase(scene, "vase on the shelf", {1.20, 1.97, shelf_top},
          {Pattern::speckle, rgb(0xe0d6c3), rgb(0x7d6b58), {}, 0.009F, 0.2F});
  addCarton(scene, "storage box", {1.62, 1.97, shelf_top}, {0.34, 0.26, 0.20},
            {Pattern::weave, rgb(0xb5838d), rgb(0x6d6875), rgb(0xd8b4a0), 0.05F});
  addBook(scene, "book on the shelf", {1.25, 1.94, shelf_middle}, {0.17, 0.24, 0.05},
          {Pattern::bookCover, rgb(0xd9902f), rgb(0x5b3a1e), rgb(0xf4e2b8), 0.03F, 0, true, 33}, true);
  addBall(scene, "globe", {1.62, 1.95, shelf_middle}, 0.11,
          {Pattern::speckle, rgb(0x3a7ca5), rgb(0x81b29a), {}, 0.06F, 0.3F});
  return scene;
}

}  // namespace

SceneRecipe makeRoomScene() {
  return {.name = "room",
          .scene = makeRoom(),
          .path = throughRoom,
          .frames = 400,
          .lit_center = {0, 0.8, 0.4},
          .lit_radius_m = 2};
}

}  // namespace scantrove::synthetic
