#include "core/capture/synthetic/objects.h"

namespace scantrove::synthetic {

SyntheticScene makeLBlockScene() {
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {5, 5, 0.1}, 0, {Pattern::tiles, rgb(0xcfc8bb), rgb(0x8f887c), {}, 0.3F},
         {0, 0, -0.1});
  addTable(scene, {}, {1.1, 1.1, 0.70}, {Pattern::wood, rgb(0xc79a66)});
  addLBlock(scene, "L block", {0, 0, 0.70, 0}, {0.26, 0.20, 0.22}, 0.08, 0.02,
            {Pattern::wood, rgb(0x7fb069)});
  return scene;
}

SyntheticScene makeChairFloorScene() {
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {4.8, 4.6, 0.1}, 0, {Pattern::planks, rgb(0xb68a5e), {}, {}, 0.13F}, {0, 0, -0.1});
  addWall(scene, "wall, back", {0, 1.55, 0, 0}, 4.8, 0xe6e1d6);
  addWall(scene, "wall, right", {2.35, 0, 0, 90}, 3.0, 0x9fb8ad);
  addChair(scene, "chair", {0.0, 0.0, 0, 8}, {Pattern::wood, rgb(0x8a5a35)},
           {Pattern::weave, rgb(0x3c7a89), rgb(0x2e5f6b), rgb(0x4f93a3), 0.02F});
  return scene;
}

}  // namespace scantrove::synthetic
