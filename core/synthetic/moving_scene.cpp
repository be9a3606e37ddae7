#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/person.h"
#include "core/synthetic/random_furniture.h"
#include "core/synthetic/random_things.h"
#include "core/synthetic/random_walls.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {
namespace {

constexpr int kMovingFrames = 420;
constexpr int kRoomsToTry = 30;   // rooms to try until everything fits
constexpr double kLane_m = -0.5;  // the person's path along x
constexpr double kOutOfSight_m = 2.0;
constexpr double kMugHeld_m = 0.05;  // above the mug's foot
constexpr double kMugLifted_m = 0.16;

/// The animated parts of a scene and their initial poses.
struct Stage {
  Layout layout;
  double side = 1;  ///< side of the table with the chair; the arm comes from the other
  Vec3 mug_from, mug_to;
  std::size_t mug = 0, mug_parts = 0;
  Vec3 chair_at;
  std::size_t chair = 0, chair_parts = 0;
};

Thing withoutShadow(Thing thing) {
  for (SyntheticScene::Part& part : thing.parts) part.material.casts_shadow = false;
  return thing;
}

Thing makePlainMug(HashStream& random) {
  SyntheticScene scene;
  addMug(scene, "mug", {}, randomGlaze(random));
  return withoutShadow(Thing(std::move(scene), true));
}

Thing makePlainChair(HashStream& random) {
  SyntheticScene scene;
  const Material frame = randomWood(random);
  const Material cushion = randomFabric(random);
  addChair(scene, "chair", {}, frame, cushion);
  return withoutShadow(Thing(std::move(scene)));
}

/// Builds back wall, table with things and the mug, and the chair beside it. False: something did not fit.
bool buildStage(HashStream& random, Stage& stage) {
  Layout& layout = stage.layout;
  stage.side = random.sign();
  const Shell shell{5.2, random.uniform(2.6, 2.9)};
  addRandomFloor(random, layout, shell);
  addRandomWall(random, layout, shell, 0);
  layout.fill({{{0, kLane_m}, {kOutOfSight_m, 0.32}, 0, 0}, 0, 2}, 0);  // the person's path

  const Vec3 size{random.uniform(1.1, 1.4), random.uniform(0.65, 0.8), random.uniform(0.68, 0.76)};
  const double table_y = kLane_m + 0.36 + size.y() / 2 + random.uniform(0, 0.06);
  Thing table = makeRandomTable(random, size);
  if (!layout.put(table, 0, table_y, 0, 0)) return false;
  const Stand top = layout.newStands().front();

  // The mug moves along the table's front edge, from the arm's side towards the middle.
  const double front = top.area.center.y() - top.area.half.y() + 0.08;
  const double first = -stage.side * (top.area.half.x() - 0.1);
  const double second = first + stage.side * random.uniform(0.35, 0.5);
  stage.mug_from = {first, front + random.uniform(0, 0.04), top.z};
  stage.mug_to = {second, front + random.uniform(0, 0.04), top.z};
  Thing mug = makePlainMug(random);
  stage.mug = layout.scene.parts().size();
  if (!layout.put(mug, stage.mug_from.x(), stage.mug_from.y(), top.z, random.uniform(0, 360))) return false;
  stage.mug_parts = layout.scene.parts().size() - stage.mug;
  const double middle = (first + second) / 2;
  layout.fill({{{middle, front + 0.02}, {std::abs(second - first) / 2 + 0.08, 0.1}, 0, 0}, top.z, 2}, 0);

  Thing chair = makePlainChair(random);
  stage.chair_at = {stage.side * (size.x() / 2 + random.uniform(0.33, 0.42)), kLane_m + 0.6, 0};
  stage.chair = layout.scene.parts().size();
  if (!layout.put(chair, stage.chair_at.x(), stage.chair_at.y(), 0, random.uniform(-20, 20))) return false;
  stage.chair_parts = layout.scene.parts().size() - stage.chair;
  // Target of the pushed chair.
  layout.fill({{stage.chair_at.head<2>() + Eigen::Vector2d(stage.side * 0.25, 0), {0.55, 0.3}, 0, 0}, 0, 1},
              0);

  layout.clutter(random, top, random.between(6, 10));
  furnishWall(random, layout, shell, 0);
  const Stand floor{{{0, 0.6}, {2.3, shell.depth / 2 - 0.6}}, 0};
  for (int i = random.between(2, 4); i > 0; --i) {
    Thing thing = makeFloorThing(random);
    layout.placeOn(random, floor, thing);
  }
  return true;
}

void setInMotion(HashStream& random, const Stage& stage, SceneRecipe& recipe) {
  // Past the table and back.
  const double speed = random.uniform(0.6, 0.75);
  const double way_s = 2 * kOutOfSight_m / speed;
  const double first_s = random.uniform(0.8, 1.4);
  const double back_s = std::max(first_s + way_s, 14 - way_s - random.uniform(1.2, 1.6));
  const Vec3 here(-stage.side * kOutOfSight_m, 0, 0);
  addPerson(random, recipe, kLane_m,
            {{first_s, here}, {first_s + way_s, -here}, {back_s, -here}, {back_s + way_s, here}});

  const double take_s = random.uniform(5.0, 5.8);
  const Vec3 held(0, 0, kMugHeld_m);
  const Vec3 lifted(0, 0, kMugHeld_m + kMugLifted_m);
  const Vec3 beside(-stage.side * 0.085, 0, 0);  // the hand holds the mug's side
  const Vec3 away = stage.mug_from + Vec3(-stage.side * 1.6, 0, 0.35);
  addArm(random, recipe, -stage.side,
         {{take_s - 1.2, away},
          {take_s, stage.mug_from + held + beside},
          {take_s + 0.2, stage.mug_from + held + beside},
          {take_s + 0.6, stage.mug_from + lifted + beside},
          {take_s + 1.6, stage.mug_to + lifted + beside},
          {take_s + 2.0, stage.mug_to + held + beside},
          {take_s + 2.2, stage.mug_to + held + beside},
          {take_s + 3.4, away}});
  const std::vector<Waypoint> mug_way{
      {take_s + 0.2, Vec3::Zero()},
      {take_s + 0.6, Vec3(0, 0, kMugLifted_m)},
      {take_s + 1.6, stage.mug_to - stage.mug_from + Vec3(0, 0, kMugLifted_m)},
      {take_s + 2.0, stage.mug_to - stage.mug_from}};
  const double push_s = random.uniform(9.0, 9.6);
  const std::vector<Waypoint> chair_way{{push_s, Vec3::Zero()},
                                        {push_s + 1.2, Vec3(stage.side * random.uniform(0.3, 0.45), 0, 0)}};
  const auto goes = [](const std::vector<Waypoint>& way) {
    return
        [way](double time_s) { return Eigen::Isometry3d(Eigen::Translation3d(alongWaypoints(way, time_s))); };
  };
  recipe.animated_parts.push_back({stage.mug, stage.mug_parts, goes(mug_way)});
  recipe.animated_parts.push_back({stage.chair, stage.chair_parts, goes(chair_way)});
}

/// In front of the person's lane, over the table: from the chair to the other side and back.
CameraPath makePathOverTable(HashStream& random, double side) {
  const double away = random.uniform(-1.4, -1.3);
  const double height = random.uniform(1.2, 1.35);
  const double gaze_height = random.uniform(0.55, 0.68);
  const double phase = random.uniform(0, 2 * std::numbers::pi);
  return [=](double time_s) -> Gaze {
    const double turn = 2 * std::numbers::pi * time_s * 30 / kMovingFrames;
    const double along = side * 0.5 * std::cos(turn);
    const double wave = std::sin(2 * turn + phase);
    return {{along, away + 0.05 * wave, height + 0.05 * std::cos(2 * turn + phase)},
            {0.75 * along, 0.2, gaze_height + 0.03 * wave}};
  };
}

}  // namespace

SceneRecipe makeRandomMovingScene(std::uint32_t seed) {
  SceneRecipe recipe{
      .name = "moving " + std::to_string(seed), .scene = {}, .path = {}, .frames = kMovingFrames};
  for (std::uint32_t room = 0; room < kRoomsToTry; ++room) {
    HashStream random(seed, 3000 + room);
    Stage stage;
    if (!buildStage(random, stage)) continue;
    recipe.scene = std::move(stage.layout.scene);
    setInMotion(random, stage, recipe);
    recipe.path = makePathOverTable(random, stage.side);
    break;
  }
  recipe.lit_center = {0, 0.3, 0.4};
  recipe.lit_radius_m = 2.6;
  return recipe;
}

}  // namespace scantrove::synthetic
