#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/synthetic/flat_things.h"
#include "core/synthetic/person.h"
#include "core/synthetic/random_boxes.h"
#include "core/synthetic/random_furniture.h"
#include "core/synthetic/random_things.h"
#include "core/synthetic/random_vessels.h"
#include "core/synthetic/random_walls.h"
#include "core/synthetic/scene_recipe.h"
#include "core/synthetic/table_settings.h"

namespace scantrove::synthetic {
namespace {

constexpr int kHandsFrames = 500;
constexpr int kTablesToTry = 30;  // tables to try until everything fits
constexpr std::size_t kTakenThings = 3;
constexpr double kFirstMove_s = 0.4;
constexpr double kMovePeriod_s = 4.9;  // the next hand sets out while the last one withdraws
constexpr double kCarried_m = 0.15;    // height of a carried thing above the table
constexpr double kHighest_m = 0.12;    // of things that stay: carried ones pass over them
constexpr double kLeastMove_m = 0.2;
constexpr double kFingerRoom_m = 0.03;
constexpr double kWidestGrip_m = 0.045;

/// A thing that a hand takes and puts down elsewhere.
struct TakenThing {
  std::size_t first_part = 0, parts = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< of its foot, world frame
  double half_width_m = 0;                      ///< between the fingers
  double grip_m = 0;                            ///< height of the finger tips above its foot
};

struct HandsTable {
  Layout layout;
  Stand top;
  std::array<TakenThing, kTakenThings> taken;
};

Thing drawGraspable(HashStream& random) {
  switch (random.below(5)) {
    case 0:
      return makeRandomMug(random);
    case 1:
      return makeRandomCan(random);
    case 2:
      return makeRandomJar(random);
    case 3:
      return makeRandomPen(random);
    default:
      return makeRandomCarton(random, 0.045, 0.085);
  }
}

/// Half the width of a thing between the fingers.
double gripWidth(const Thing& thing) { return thing.parts.front().shape->bounds().high.x(); }

/// A thing that fits into a hand.
Thing makeGraspable(HashStream& random) {
  Thing thing = drawGraspable(random);
  while (gripWidth(thing) > kWidestGrip_m) thing = drawGraspable(random);
  return thing;
}

/// A free place for the thing on the stand, at least `kLeastMove_m` from `apart_from`.
std::optional<Eigen::Vector2d> findSpot(HashStream& random, const Layout& layout, const Stand& stand,
                                        const Thing& thing, double yaw_deg,
                                        const std::optional<Eigen::Vector2d>& apart_from) {
  for (int attempt = 0; attempt < 60; ++attempt) {
    const double x = random.uniform(-stand.area.half.x(), stand.area.half.x());
    const double y = random.uniform(-stand.area.half.y(), stand.area.half.y());
    const Eigen::Vector2d at = stand.area.center + Eigen::Vector2d(x, y);
    const Volume placed = thing.volumes.front().placedAt(at.x(), at.y(), stand.z, yaw_deg);
    if (!contains(stand.area, placed.base) || layout.clearance({placed}, 0) < kFingerRoom_m) continue;
    if (!apart_from || (at - *apart_from).norm() >= kLeastMove_m) return at;
  }
  return std::nullopt;
}

/// Places a thing to be taken and keeps its destination free. None: no room.
std::optional<TakenThing> placeTaken(HashStream& random, Layout& layout, const Stand& stand) {
  Thing thing = makeGraspable(random);
  for (SyntheticScene::Part& part : thing.parts) part.material.casts_shadow = false;  // shadows are static
  const double yaw_deg = thing.who.name == "mug" ? 90 : 0;  // the handle away from the fingers
  TakenThing taken;
  taken.half_width_m = gripWidth(thing);
  taken.grip_m = std::max(kFingerRadius_m + 0.0015, thing.height() - 0.055);
  const auto from = findSpot(random, layout, stand, thing, yaw_deg, std::nullopt);
  if (!from) return std::nullopt;
  taken.from = {from->x(), from->y(), stand.z};
  taken.first_part = layout.scene.parts().size();
  if (!layout.put(thing, from->x(), from->y(), stand.z, yaw_deg)) return std::nullopt;
  taken.parts = layout.scene.parts().size() - taken.first_part;
  const auto to = findSpot(random, layout, stand, thing, yaw_deg, from);
  if (!to) return std::nullopt;
  taken.to = {to->x(), to->y(), stand.z};
  for (const Eigen::Vector2d& at : {*from, *to}) {  // the fingers need room, too
    Volume reserved = thing.volumes.front().placedAt(at.x(), at.y(), stand.z, yaw_deg);
    reserved.base.round += kFingerRoom_m;
    layout.fill(reserved, 0);
  }
  return taken;
}

/// Floor, wall, table, things to be taken, and low ones that stay. False: something did not fit.
bool buildHandsTable(HashStream& random, HandsTable& table) {
  Layout& layout = table.layout;
  const Shell shell{random.uniform(2.8, 3.6), random.uniform(2.8, 3.6)};
  addRandomFloor(random, layout, shell);
  addRandomWall(random, layout, shell, 0);
  Thing desk = makeRandomTable(
      random, {random.uniform(1.0, 1.4), random.uniform(0.7, 0.9), random.uniform(0.7, 0.76)});
  if (!layout.put(desk, 0, 0, 0, 0)) return false;
  const Stand bare = layout.newStands().front();
  table.top = spreadCloth(random, layout, bare);
  Stand used = table.top;
  used.area.half = used.area.half.cwiseMin(Eigen::Vector2d(0.34, 0.25));
  for (TakenThing& taken : table.taken) {
    const std::optional<TakenThing> placed = placeTaken(random, layout, used);
    if (!placed) return false;
    taken = *placed;
  }
  for (int i = random.between(4, 7); i > 0; --i) {
    Thing flat = makeRandomFlatThing(random);
    layout.placeOn(random, used, flat);
  }
  for (int i = random.between(8, 14); i > 0; --i) {
    Thing thing = makeSmallThing(random);
    if (thing.height() < kHighest_m) layout.placeOn(random, used, thing);
  }
  placeChairsAt(random, layout, bare, random.between(0, 2));
  return true;
}

/// Adds the keys of a hand that takes a thing, from `start_s` on. The result: keys of the thing, which it
/// shares with the hand while it is held. `held`: from its first place to where it is shown.
std::vector<Waypoint> addMove(const TakenThing& taken, const Vec3& away, const Vec3& held, double start_s,
                              HandMotion& hand) {
  const Vec3 grip = taken.from + Vec3(0, 0, taken.grip_m);
  const Vec3 shift = taken.to - taken.from;
  const Vec3 up(0, 0, kCarried_m);
  const auto at = [&](double after_s, const Vec3& moved) {
    hand.way.push_back({start_s + after_s, grip + moved});
  };
  hand.way.push_back({start_s, away});
  at(1.1, up);
  at(1.5, Vec3::Zero());
  std::vector<Waypoint> carried{{start_s + 1.7, Vec3::Zero()}, {start_s + 2.1, up},
                                {start_s + 2.8, held},         {start_s + 3.5, held},
                                {start_s + 4.2, shift + up},   {start_s + 4.7, shift}};
  for (const Waypoint& key : carried) hand.way.push_back({key.time_s, grip + key.at});
  at(4.9, shift);
  at(5.3, shift + up);
  hand.way.push_back({start_s + 6.2, away});
  const Vec3 closed(taken.half_width_m, 0, 0);
  const Vec3 open = closed + Vec3(0.02, 0, 0);
  for (const auto& [after_s, opening] :
       {std::pair(1.5, open), std::pair(1.7, closed), std::pair(4.7, closed), std::pair(4.9, open)})
    hand.opening.push_back({start_s + after_s, opening});
  return carried;
}

void setHandsInMotion(HashStream& random, const HandsTable& table, SceneRecipe& recipe) {
  HandMotion left{"hand, left", -1, random.uniform(-25, -5), {}, {}};
  HandMotion right{"hand, right", 1, random.uniform(5, 25), {}, {}};
  const bool is_right_first = random.chance(0.5);
  for (std::size_t i = 0; i < kTakenThings; ++i) {
    const TakenThing& taken = table.taken[i];
    HandMotion& hand = (i % 2 == 0) == is_right_first ? right : left;
    const Vec3 away(hand.side * 0.35, -1.2, table.top.z + 0.25);
    const double x = hand.side * 0.08 + random.uniform(-0.05, 0.05);
    const double y = random.uniform(-0.1, 0.05);
    const Vec3 held = Vec3(x, y, table.top.z + random.uniform(0.17, 0.24)) - taken.from;
    const double start_s = kFirstMove_s + static_cast<double>(i) * kMovePeriod_s;
    const std::vector<Waypoint> way = addMove(taken, away, held, start_s, hand);
    recipe.animated_parts.push_back({taken.first_part, taken.parts, [way](double time_s) {
                                       return Eigen::Isometry3d(
                                           Eigen::Translation3d(alongWaypoints(way, time_s)));
                                     }});
  }
  addHand(random, recipe, left);
  addHand(random, recipe, right);
}

/// A tripod beside the table that looks down at its middle.
CameraPath makeTripod(HashStream& random, const Stand& top) {
  const double tilt = random.uniform(12, 32) / 180 * std::numbers::pi;
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const double height = random.uniform(0.8, 0.95);
  const double away = height * std::tan(tilt);
  const Vec3 target(top.area.center.x(), top.area.center.y(), top.z);
  const Gaze gaze{target + Vec3(away * std::cos(azimuth), away * std::sin(azimuth), height), target};
  return [gaze](double /*time_s*/) { return Gaze(gaze); };
}

}  // namespace

SceneRecipe makeRandomHandsScene(std::uint32_t seed) {
  SceneRecipe recipe{
      .name = "hands " + std::to_string(seed), .scene = {}, .path = {}, .frames = kHandsFrames};
  for (std::uint32_t attempt = 0; attempt < kTablesToTry; ++attempt) {
    HashStream random(seed, 13000 + attempt);
    HandsTable table{Layout(seed), {}, {}};
    if (!buildHandsTable(random, table)) continue;
    recipe.scene = std::move(table.layout.scene);
    setHandsInMotion(random, table, recipe);
    recipe.path = makeTripod(random, table.top);
    break;
  }
  recipe.lit_center = {0, 0, 0.4};
  recipe.lit_radius_m = 1.8;
  makeHard(recipe, seed);
  recipe.is_hand_held = false;
  return recipe;
}

}  // namespace scantrove::synthetic
