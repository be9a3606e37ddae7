#include "core/synthetic/random_things.h"

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/random_boxes.h"
#include "core/synthetic/random_vessels.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

using Add = std::uint16_t (*)(SyntheticScene&, const std::string&, const Place&, const Material&);

/// One of the things of the fixed scenes.
Thing known(Add add, const std::string& name, const Material& material, bool round = false) {
  SyntheticScene scene;
  add(scene, name, {}, material);
  return Thing(std::move(scene), round);
}

Thing cactus() {
  SyntheticScene scene;
  addCactus(scene, "cactus", {});
  return Thing(std::move(scene));
}

Thing bear(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("bear", true, true);
  Material fur{Pattern::speckle, randomColor(random)};
  fur.second = fur.main * 0.8F;
  fur.scale = 0.01F;
  const double r = random.uniform(0.05, 0.09);
  const auto ball = [&](double radius, const Vec3& at) {
    addPart(scene, id, {}, std::make_unique<Sphere>(radius * r), fur, at * r);
  };
  ball(1.0, {0, 0, 1.0});
  ball(0.72, {0, -0.1, 2.35});
  ball(0.3, {0, -0.75, 2.2});
  for (const double s : {-1.0, 1.0}) {
    ball(0.42, {s * 0.6, -0.8, 0.42});
    ball(0.34, {s * 1.05, -0.3, 1.25});
    ball(0.26, {s * 0.55, 0, 2.95});
  }
  return Thing(std::move(scene));
}

Thing car(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("toy car", true, true);
  const Material body{Pattern::plain, randomColor(random), {}, {}, 0.03F, 0.4F};
  const Material tyre{Pattern::plain, rgb(0x2b2b2e)};
  const double length = random.uniform(0.14, 0.28);
  const double width = length * 0.45;
  const double wheel = length * 0.13;
  addBox(scene, id, {}, {length, width, length * 0.2}, 0.008, body, {0, 0, wheel * 0.8});
  addBox(scene, id, {}, {length * random.uniform(0.35, 0.6), width * 0.9, length * 0.38}, 0.012, body,
         {-0.1 * length, 0, wheel * 0.8});
  for (const double x : {-0.3, 0.3}) {
    for (const double s : {-1.0, 1.0}) {
      addPart(scene, id, {}, std::make_unique<Lathe>(canProfile(wheel, wheel, length * 0.08)), tyre,
              {x * length, s * width * 0.5 - length * 0.04, wheel}, turned(-90, Vec3::UnitX()));
    }
  }
  return Thing(std::move(scene));
}

Thing ball(HashStream& random, double low_m, double high_m) {
  SyntheticScene scene;
  const double radius = random.uniform(low_m, high_m);
  addBall(scene, "ball", {}, radius, randomGlaze(random));
  return Thing(std::move(scene), true);
}

Thing chair(HashStream& random) {
  SyntheticScene scene;
  const Material frame = randomPaintwork(random);
  addChair(scene, "chair", {}, frame, randomFabric(random));
  Thing chair(std::move(scene));
  const Footprint all = chair.volumes.front().base;
  Footprint back = all;
  back.half.y() = 0.07;
  back.center.y() = all.center.y() + all.half.y() - 0.07;
  chair.volumes = {{all, 0, 0.485}, {back, 0.485, 0.90}};
  chair.stands = {{{{0, -0.04}, {0.16, 0.14}}, 0.485}};
  return chair;
}

}  // namespace

Thing makeRandomToy(HashStream& random) {
  switch (random.below(6)) {
    case 0:
      return bear(random);
    case 1:
      return car(random);
    case 2:
      return known(addRing, "ring", randomGlaze(random), true);
    case 3:
      return known(addArch, "arch", randomGlaze(random));
    default:
      return ball(random, 0.03, 0.08);
  }
}

Thing makeSmallThing(HashStream& random) {
  switch (random.below(19)) {
    case 0:
      return makeRandomMug(random);
    case 1:
      return makeRandomVase(random);
    case 2:
      return makeRandomBowl(random);
    case 3:
      return makeRandomPlate(random);
    case 4:
      return makeRandomCan(random);
    case 5:
      return makeRandomJar(random);
    case 6:
      return makeRandomBottle(random);
    case 7:
      return makeRandomRoll(random);
    case 8:
      return makeRandomFigure(random);
    case 9: {  // lying
      Thing thing = random.chance(0.5) ? makeRandomRoll(random) : makeRandomBottle(random);
      return std::move(thing.layDown());
    }
    case 10:
    case 11:
      return makeRandomToy(random);
    case 12:
      return makeRandomBlocks(random);
    case 13:
      return random.chance(0.4) ? makeRandomLaptop(random) : makeRandomMug(random);
    case 14:
      return random.chance(0.5) ? known(addTeapot, "teapot", randomGlaze(random)) : cactus();
    case 15:
      return known(addLamp, "lamp", randomGlaze(random), true);
    default:
      return makeStackable(random);
  }
}

Thing makeStackable(HashStream& random) {
  switch (random.below(5)) {
    case 0:
      return makeRandomCarton(random, 0.05, 0.12);
    case 1:
      return makeRandomCarton(random, 0.07, 0.25);
    case 2:
      return makeRandomCan(random);
    default:
      return makeRandomBook(random);
  }
}

Thing makeFloorThing(HashStream& random) {
  switch (random.below(10)) {
    case 0:
    case 1:
      return chair(random);
    case 2:
      return std::move(known(addStool, "stool", randomPaintwork(random), true).withTop(0.03));
    case 3:
      return random.chance(0.5) ? known(addBasket, "basket", randomGlaze(random), true)
                                : makeRandomBucket(random);
    case 4:
      return makeRandomBucket(random);
    case 5:
      return makeRandomSuitcase(random);
    case 6:
      return makeRandomShoe(random);
    case 7:
      return random.chance(0.6) ? ball(random, 0.09, 0.14) : makeRandomCushion(random);
    default:
      return makeRandomCarton(random, 0.18, 0.5);
  }
}

}  // namespace scantrove::synthetic
