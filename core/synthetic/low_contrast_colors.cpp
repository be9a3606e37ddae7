#include "core/synthetic/low_contrast_colors.h"

#include <array>

#include "core/synthetic/palette.h"

namespace scantrove::synthetic {
namespace {

constexpr double kMaxCommon = 0.5, kSecond = 0.8;  // shares of things, up to the first and second tint
constexpr double kOtherSkin = 0.2;                 // share of parts whose tint differs from their thing

std::size_t pickTint(HashStream& random) {
  const double part = random.uniform(0, 1);
  return part < kMaxCommon ? 0 : (part < kSecond ? 1 : 2);
}

}  // namespace

SyntheticScene makeLowContrast(SyntheticScene scene, std::uint32_t seed) {
  HashStream of_scene(seed, 7000);
  const Rgb paint = randomPaint(of_scene);
  const Rgb wood = randomWood(of_scene).main;
  const std::array<Rgb, 3> tints{paint, wood, randomColor(of_scene)};
  SyntheticScene low_contrast;
  for (const InstanceName& who : scene.instances()) {
    low_contrast.addInstance(who.name, who.is_object, who.non_convex);
  }
  std::uint32_t number = 0;
  for (SyntheticScene::Part& part : std::move(scene).takeParts()) {
    HashStream of_thing(seed, 7001U + part.instance);
    HashStream of_part(seed, 8000U + ++number);
    const std::size_t things_tint = pickTint(of_thing);
    const float shade = static_cast<float>(of_thing.uniform(0.85, 1.15));
    const Rgb main = shade * tints[of_part.chance(kOtherSkin) ? pickTint(of_part) : things_tint];
    part.material.main = main;
    part.material.second = main * 0.8F;
    part.material.third = main * 0.6F + Rgb::Constant(0.3F);
    low_contrast.add(part.instance, std::move(part.shape), part.T_world_part, part.material);
  }
  return low_contrast;
}

}  // namespace scantrove::synthetic
