#include "core/synthetic/curtain.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/objects.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

Thing makeCurtain(HashStream& random, double length) {
  SyntheticScene scene;
  const auto id = scene.addInstance("curtain", false, true);
  Material cloth = randomFabric(random);
  cloth.casts_shadow = false;
  const double depth = random.uniform(0.07, 0.12);
  const double low = random.uniform(0.0, 0.05);
  const double high = random.uniform(2.1, 2.4);
  addPart(
      scene, id, {},
      std::make_unique<Curtain>(Vec3(length, depth, high - low), 0.004, length / random.uniform(0.11, 0.2)),
      cloth, {0, -depth / 2 - 0.01, (low + high) / 2});
  Thing curtain(std::move(scene));
  for (SyntheticScene::Part& part : curtain.parts) part.T_world_part.pretranslate(Vec3(0, 0, low));
  curtain.volumes.front().z_high = high;
  return curtain;
}

Thing makeRug(HashStream& random) {
  SyntheticScene scene;
  Material cloth = randomFabric(random);
  cloth.pattern = Pattern::weave;
  const Vec3 size{random.uniform(0.9, 2.0), random.uniform(0.6, 1.4), random.uniform(0.005, 0.014)};
  addBox(scene, scene.addInstance("rug", false), {}, size, 0.004, cloth);
  return std::move(Thing(std::move(scene)).withTop(0.02));
}

}  // namespace scantrove::synthetic
