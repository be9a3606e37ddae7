#include <memory>
#include <numbers>
#include <utility>

#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/random_furniture.h"
#include "core/synthetic/random_things.h"
#include "core/synthetic/random_walls.h"
#include "core/synthetic/rounded_shapes.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {
namespace {

constexpr int kTurntableFrames = 240;      // one turn, 1.5 degrees a frame
constexpr double kTurn_s = 8;              // at 30 frames a second
constexpr int kTurntableTablesToTry = 20;  // tables to try until everything fits
constexpr double kDisc_m = 0.2;            // its radius
constexpr double kDiscHeight_m = 0.03;

/// A material with print or pattern all around, so that no side is bare.
Material drawPrint(HashStream& random, Pattern pattern, double scale_m) {
  Material print = randomPrint(random, pattern);
  print.scale = static_cast<float>(scale_m);
  print.gloss = 0;
  print.casts_shadow = false;  // shadows do not turn
  return print;
}

/// Adds the lower part of the thing. The result: its half width along x and y, and its height.
Vec3 addBody(HashStream& random, SyntheticScene& scene, std::uint16_t id) {
  const Vec3 half(random.uniform(0.048, 0.062), random.uniform(0.036, 0.046), random.uniform(0.09, 0.12));
  const Material print = drawPrint(random, Pattern::packaging, 0.03);
  switch (random.below(3)) {
    case 0:  // a carton
      addBox(scene, id, {}, {2 * half.x(), 2 * half.y(), half.z()}, 0.002, print);
      break;
    case 1: {  // an L: its upper part covers one side only
      addBox(scene, id, {}, {2 * half.x(), 2 * half.y(), 0.6 * half.z()}, 0.002, print);
      addBox(scene, id, {}, {1.2 * half.x(), 2 * half.y(), half.z()}, 0.002, print, {-0.4 * half.x(), 0, 0});
      break;
    }
    default:  // a tin on a plate
      addBox(scene, id, {}, {2 * half.x(), 2 * half.y(), 0.014}, 0.002, print);
      addPart(scene, id, {}, std::make_unique<Lathe>(canProfile(half.y(), 0.9 * half.y(), half.z())),
              drawPrint(random, Pattern::canLabel, 0.03));
  }
  return half;
}

/// A printed thing without symmetry: a body with a block askew and a ball on its top, and a handle at one
/// side. 12 - 25 cm.
Thing makeTurningThing(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("thing", true, true);
  const Vec3 body = addBody(random, scene, id);
  const Vec3 block(random.uniform(0.040, 0.052), random.uniform(0.030, 0.040), random.uniform(0.035, 0.055));
  const double askew = random.uniform(20, 70);
  addPart(scene, id, {}, std::make_unique<RoundedBox>(block / 2, 0.002),
          drawPrint(random, Pattern::checker, 0.011),
          {-0.35 * body.x(), 0.1 * body.y(), body.z() + block.z() / 2 - 0.002}, turned(askew, Vec3::UnitZ()));
  const double ball = random.uniform(0.016, 0.021);
  addPart(scene, id, {}, std::make_unique<Sphere>(ball), drawPrint(random, Pattern::dots, 0.012),
          {-0.35 * body.x(), 0.1 * body.y(), body.z() + block.z() + 0.7 * ball});
  const double ring = random.uniform(0.018, 0.022);
  Eigen::Matrix3d upright;  // the ring stands, its cut side inwards
  upright.col(0) = Vec3::UnitZ();
  upright.col(1) = Vec3::UnitX();
  upright.col(2) = Vec3::UnitY();
  const Vec3 at(body.x() - 0.004, 0.2 * body.y(), 0.031);
  addPart(scene, id, {}, std::make_unique<Torus>(ring, 0.0075, 0.0),
          drawPrint(random, Pattern::stripes, 0.01), at, upright);
  return Thing(std::move(scene));
}

Thing makeDisc(HashStream& random) {
  SyntheticScene scene;
  Material skin{Pattern::plain, randomPaint(random)};
  skin.casts_shadow = false;
  addPart(scene, scene.addInstance("turntable", false), {},
          std::make_unique<Lathe>(canProfile(kDisc_m, kDisc_m, kDiscHeight_m)), skin);
  return std::move(Thing(std::move(scene), true).withTop(0.01));
}

struct TurntableRoom {
  Layout layout;
  std::size_t first_part = 0, parts = 0;  ///< of the disc and the thing
  Vec3 foot = Vec3::Zero();               ///< the middle of the disc's top
  double height_m = 0;                    ///< of the thing
};

/// Room, table, disc, thing, and things that stand still. False: something did not fit.
bool buildTurntableRoom(HashStream& random, TurntableRoom& room) {
  Layout& layout = room.layout;
  const Shell shell{random.uniform(2.8, 3.4), random.uniform(2.8, 3.4)};
  addRandomFloor(random, layout, shell);
  for (const int wall : {0, 1, 3}) addRandomWall(random, layout, shell, wall);
  Thing table = makeRandomTable(
      random, {random.uniform(1.1, 1.4), random.uniform(0.75, 0.9), random.uniform(0.7, 0.76)});
  if (!layout.put(table, 0, 0, 0, 0)) return false;
  const Stand top = layout.newStands().front();
  room.first_part = layout.scene.parts().size();
  Thing disc = makeDisc(random);
  if (!layout.put(disc, 0, -0.05, top.z, 0)) return false;
  const auto disc_id = static_cast<std::uint16_t>(layout.scene.instances().size());
  room.foot = {0, -0.05, layout.newStands().front().z};
  Thing thing = makeTurningThing(random);
  room.height_m = thing.height();
  if (!layout.put(thing, 0, -0.05, room.foot.z(), random.uniform(0, 360))) return false;
  room.parts = layout.scene.parts().size() - room.first_part;
  // Nothing stands beside the disc or in the camera's way.
  layout.fill({{{0, -0.45}, {0.34, 0.68}}, top.z, top.z + 1}, disc_id);
  for (int i = random.between(5, 9); i > 0; --i) {
    Thing beside = makeSmallThing(random);
    layout.placeOn(random, top, beside);
  }
  furnishWall(random, layout, shell, 0);
  return true;
}

/// A tripod before the table that looks down at the thing.
CameraPath makeTripodBefore(HashStream& random, const TurntableRoom& room) {
  const double elevation = random.uniform(30, 40) / 180 * std::numbers::pi;
  const double azimuth = random.uniform(-105, -75) / 180 * std::numbers::pi;
  const double distance = random.uniform(0.55, 0.6);
  const Vec3 target = room.foot + Vec3(0, 0, room.height_m / 2);
  const double away = distance * std::cos(elevation);
  const Gaze gaze{
      target + Vec3(away * std::cos(azimuth), away * std::sin(azimuth), distance * std::sin(elevation)),
      target};
  return [gaze](double /*time_s*/) { return Gaze(gaze); };
}

}  // namespace

SceneRecipe makeRandomTurntableScene(std::uint32_t seed) {
  SceneRecipe recipe{
      .name = "turntable " + std::to_string(seed), .scene = {}, .path = {}, .frames = kTurntableFrames};
  for (std::uint32_t attempt = 0; attempt < kTurntableTablesToTry; ++attempt) {
    HashStream random(seed, 15000 + attempt);
    TurntableRoom room;
    if (!buildTurntableRoom(random, room)) continue;
    recipe.path = makeTripodBefore(random, room);
    recipe.scene = std::move(room.layout.scene);
    const auto turn = [axis = room.foot](double time_s) {
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      motion.translate(axis);
      motion.rotate(Eigen::AngleAxisd(2 * std::numbers::pi * time_s / kTurn_s, Vec3::UnitZ()));
      motion.translate(-axis);
      return motion;
    };
    recipe.animated_parts.push_back({room.first_part, room.parts, turn});
    recipe.reference = turn;
    recipe.lit_center = room.foot;
    break;
  }
  recipe.lights.to_sun = Vec3::UnitZ();  // a thing that turns below it keeps its shading
  recipe.is_hand_held = false;
  return recipe;
}

}  // namespace scantrove::synthetic
