#include "core/synthetic/random_vessels.h"

#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

std::unique_ptr<Shape> latheOf(const Lathe::Profile& profile) { return std::make_unique<Lathe>(profile); }

Thing turnedOne(const std::string& name, bool non_convex, const Lathe::Profile& profile,
                const Material& material) {
  SyntheticScene scene;
  addPart(scene, scene.addInstance(name, true, non_convex), {}, latheOf(profile), material);
  return Thing(std::move(scene), true);
}

}  // namespace

Thing makeRandomMug(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("mug", true, true);
  const Material glaze = randomGlaze(random);
  const double radius = random.uniform(0.035, 0.055);
  const double height = random.uniform(0.075, 0.13);
  const double foot = radius * random.uniform(0.7, 1.0);
  Lathe::Profile outer;
  appendArc(outer, {foot - 0.006, 0.006}, 0.006, -90, 0, 4);
  outer.emplace_back(radius, height / 2);
  outer.emplace_back(radius, height);
  addPart(scene, id, {}, latheOf(vesselProfile(outer, 0.005)), glaze);
  Material handle = glaze;
  handle.pattern = Pattern::plain;
  Eigen::Matrix3d turn;
  turn.col(0) = Vec3::UnitZ();
  turn.col(1) = Vec3::UnitX();
  turn.col(2) = Vec3::UnitY();
  const double tube = random.uniform(0.005, 0.008);
  addPart(scene, id, {}, std::make_unique<Torus>(height * 0.29, tube, -0.005), handle,
          {radius + 0.0025, 0, height * 0.53}, turn);
  return Thing(std::move(scene));
}

Thing makeRandomVase(HashStream& random) {
  const double height = random.uniform(0.14, 0.34);
  const double foot = random.uniform(0.03, 0.05);
  const double belly = random.uniform(0.045, 0.085);
  const double neck = random.uniform(0.022, 0.04);
  const double waist = random.uniform(0.3, 0.5);
  const auto side = smoothProfile({{foot, 0},
                                   {(foot + belly) / 2, 0.2 * height},
                                   {belly, waist * height},
                                   {(belly + neck) / 2, 0.72 * height},
                                   {neck, 0.87 * height},
                                   {neck * random.uniform(1.0, 1.5), height}},
                                  5);
  return turnedOne("vase", true, vesselProfile(side, 0.005), randomGlaze(random));
}

Thing makeRandomBowl(HashStream& random) {
  const double radius = random.uniform(0.065, 0.14);
  const double height = radius * random.uniform(0.45, 0.9);
  const double foot = radius * random.uniform(0.35, 0.6);
  Lathe::Profile outer{{foot, 0.0}, {foot + 0.001, 0.006}};
  const auto side = smoothProfile({{foot + 0.002, 0.010},
                                   {(foot + radius) * 0.54, 0.3 * height},
                                   {radius * 0.93, 0.7 * height},
                                   {radius, height}},
                                  6);
  outer.insert(outer.end(), side.begin(), side.end());
  return turnedOne("bowl", true, vesselProfile(outer, 0.006), randomGlaze(random));
}

Thing makeRandomPlate(HashStream& random) {
  const double radius = random.uniform(0.08, 0.14);
  return turnedOne(
      "plate", true,
      {{0, 0}, {radius * 0.6, 0}, {radius, 0.018}, {radius, 0.024}, {radius * 0.58, 0.008}, {0, 0.008}},
      randomGlaze(random));
}

Thing makeRandomCan(HashStream& random) {
  const double radius = random.uniform(0.027, 0.055);
  const double height = random.uniform(0.06, 0.19);
  Thing can =
      turnedOne("can", false, canProfile(radius, radius, height), randomPrint(random, Pattern::canLabel));
  return std::move(can.withTop(0.004));
}

Thing makeRandomJar(HashStream& random) {
  const double radius = random.uniform(0.035, 0.065);
  const double height = random.uniform(0.09, 0.2);
  const double lid = radius * random.uniform(0.75, 1.1);
  Lathe::Profile profile{{0, 0}};
  appendArc(profile, {radius - 0.008, 0.008}, 0.008, -90, 0, 4);
  appendArc(profile, {radius - 0.012, 0.8 * height - 0.012}, 0.012, 0, 90, 4);
  profile.insert(profile.end(),
                 {{lid, 0.81 * height}, {lid, height - 0.002}, {lid - 0.002, height}, {0, height}});
  Thing jar = turnedOne("jar", true, profile, randomPrint(random, Pattern::canLabel));
  return std::move(jar.withTop(0.004));
}

Thing makeRandomBottle(HashStream& random) {
  const double radius = random.uniform(0.028, 0.05);
  const double height = random.uniform(0.18, 0.34);
  const double neck = random.uniform(0.012, 0.017);
  const double shoulder = random.uniform(0.5, 0.7);
  Lathe::Profile profile{{0, 0}};
  appendArc(profile, {radius - 0.008, 0.008}, 0.008, -90, 0, 4);
  const auto side = smoothProfile({{radius, shoulder * height},
                                   {radius * 0.85, (shoulder + 0.1) * height},
                                   {neck * 1.15, (shoulder + 0.22) * height},
                                   {neck, 0.92 * height}},
                                  5);
  profile.insert(profile.end(), side.begin(), side.end());
  profile.insert(profile.end(), {{neck + 0.003, 0.925 * height}, {neck + 0.003, height}, {0, height}});
  return turnedOne("bottle", true, profile, randomPrint(random, Pattern::canLabel));
}

Thing makeRandomRoll(HashStream& random) {
  const double outer = random.uniform(0.04, 0.065);
  const double inner = outer * random.uniform(0.3, 0.6);
  const double height = random.uniform(0.08, 0.24);
  const Material paper{Pattern::plain, randomPaint(random)};
  return turnedOne("roll", true, {{inner, 0}, {outer, 0}, {outer, height}, {inner, height}, {inner, 0}},
                   paper);
}

Thing makeRandomFigure(HashStream& random) {
  const double height = random.uniform(0.1, 0.3);
  Lathe::Profile knots{{height * random.uniform(0.22, 0.34), 0}};
  for (const double z : {0.15, 0.35, 0.5, 0.65, 0.8}) {
    knots.emplace_back(height * random.uniform(0.09, 0.3), height * z);
  }
  knots.emplace_back(0, height);
  Lathe::Profile profile{{0, 0}};
  const auto side = smoothProfile(knots, 5);
  profile.insert(profile.end(), side.begin(), side.end());
  return turnedOne("figure", true, profile, randomGlaze(random));
}

Thing makeRandomBucket(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance(random.pick({"bucket", "flower pot", "waste basket"}), true, true);
  const double foot = random.uniform(0.08, 0.14);
  const double top = foot * random.uniform(1.1, 1.5);
  const double height = random.uniform(0.18, 0.36);
  const Material skin = randomGlaze(random);
  addPart(
      scene, id, {},
      latheOf({{0, 0}, {foot, 0}, {top, height}, {top - 0.006, height}, {foot - 0.006, 0.006}, {0, 0.006}}),
      skin);
  if (random.chance(0.5)) {  // a plant in its earth
    const Material earth{Pattern::speckle, rgb(0x4a3628), rgb(0x6e5442), {}, 0.006F};
    const double level = 0.8 * height;
    const double inner = foot - 0.006 + (top - foot) * level / height;
    addPart(scene, id, {}, latheOf({{0, level - 0.02}, {inner, level - 0.02}, {inner, level}, {0, level}}),
            earth);
    const Material leaves{Pattern::speckle, rgb(0x3f7d4a), rgb(0x6fae5e), {}, 0.03F};
    addPart(scene, id, {}, latheOf(canProfile(0.012, 0.009, height * 0.7)), earth, {0, 0, level - 0.01});
    const int crowns = random.between(2, 4);
    for (int i = 0; i < crowns; ++i) {
      const double radius = top * random.uniform(0.5, 0.85);
      const Vec3 offset{random.uniform(-0.4, 0.4) * top, random.uniform(-0.4, 0.4) * top,
                        level + height * 0.6 + i * 0.06};
      addPart(scene, id, {}, std::make_unique<Sphere>(radius), leaves, offset);
    }
  }
  return Thing(std::move(scene), true);
}

}  // namespace scantrove::synthetic
