#include <cmath>
#include <numbers>
#include <optional>

#include "core/synthetic/camera_work.h"
#include "core/synthetic/random_furniture.h"
#include "core/synthetic/random_things.h"
#include "core/synthetic/random_walls.h"
#include "core/synthetic/scene_recipe.h"
#include "core/synthetic/table_settings.h"

namespace scantrove::synthetic {
namespace {

constexpr double kRoomSeconds = 10;  // 300 frames
constexpr int kRooms = 12;           // rooms to try until one has good camera paths
constexpr int kPathsInRoom = 40;     // tried in each
constexpr int kSweepFrames = 400;
constexpr double kSweepSeconds = kSweepFrames / 30.0;

/// A table of random height amid the clutter, with things on it and chairs around and under it.
void addIsland(HashStream& random, Layout& layout, const Stand& floor) {
  const bool low = random.chance(0.35);
  const Vec3 size{random.uniform(0.8, 1.5), random.uniform(0.55, 0.85),
                  low ? random.uniform(0.38, 0.5) : random.uniform(0.68, 0.76)};
  Thing table = makeRandomTable(random, size);
  Stand around = floor;
  Thing rug = makeRug(random);
  if (random.chance(0.5) && layout.placeOn(random, floor, rug)) around = layout.newStands().front();
  if (!layout.placeOn(random, around, table) && !layout.placeOn(random, floor, table)) return;
  const Stand bare = layout.newStands().front();
  const Stand top = layout.isHard() ? spreadCloth(random, layout, bare) : bare;
  layout.clutter(random, top, random.between(6, 14));
  if (layout.isHard() && !low) placeChairsAt(random, layout, bare, random.between(1, 4));
}

void addFloorClutter(HashStream& random, Layout& layout, const Stand& floor) {
  for (int i = random.between(10, 18); i > 0; --i) {
    if (random.chance(0.2)) {
      layout.stack(random, floor, random.between(2, 4));
      continue;
    }
    Thing thing = layout.drawFloorThing(random);
    if (layout.placeOn(random, floor, thing) && !layout.newStands().empty() && random.chance(0.6)) {
      const Stand top = layout.newStands().front();
      layout.stack(random, top, random.between(1, 3));
    }
  }
  for (int i = random.between(3, 8); i > 0; --i) {
    const auto faces = static_cast<int>(layout.faces().size());
    layout.lean(random, layout.faces()[static_cast<std::size_t>(random.below(faces))]);
  }
}

/// The target follows a rectangle along the walls; the eye keeps its distance within the room.
CameraPath makePath(HashStream& random, const Shell& shell) {
  const double first = random.uniform(0, 2 * std::numbers::pi);
  const double sweep = random.sign() * random.uniform(1.6, 2.8);
  const double away = random.uniform(1.15, 1.9);
  const double skew = random.uniform(-0.5, 0.5);
  const double skew_change = random.uniform(-0.6, 0.6);
  const double height = random.uniform(1.05, 1.45);
  const double target_height = random.uniform(0.35, 0.85);
  const double inset = random.uniform(0.25, 0.7);
  constexpr int kPoints = 9;
  std::vector<Gaze> points;
  for (int i = 0; i < kPoints; ++i) {
    const double part = static_cast<double>(i) / (kPoints - 1);
    const double angle = first + sweep * part;
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    const double to_wall = std::min((shell.width / 2 - inset) / std::max(std::abs(out.x()), 1e-6),
                                    (shell.depth / 2 - inset) / std::max(std::abs(out.y()), 1e-6));
    const Eigen::Vector2d target = out * std::min(to_wall, 2.2);
    const double back = angle + std::numbers::pi + skew + skew_change * part;
    const double wave_target = random.uniform(-0.15, 0.2);
    const double wave_away = random.uniform(-0.15, 0.15);
    const double wave_height = random.uniform(-0.12, 0.12);
    const Eigen::Vector2d eye = target + (away + wave_away) * Eigen::Vector2d(std::cos(back), std::sin(back));
    points.push_back(
        {{eye.x(), eye.y(), height + wave_height}, {target.x(), target.y(), target_height + wave_target}});
  }
  return alongAtHandsPace(std::move(points));
}

/// The eye follows the walls at `inset` from them, close to the furniture, and looks obliquely ahead. Near
/// things pass on one side of the image; the far end of the room is on the other.
CameraPath makeSweep(HashStream& random, const Shell& shell, double inset) {
  const double first = random.uniform(0, 2 * std::numbers::pi);
  const double way = random.sign();
  const double sweep = random.uniform(1.5, 3.0);
  const double height = random.uniform(0.85, 1.35);
  constexpr int kPoints = 10;
  std::vector<Gaze> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = first + way * sweep * i / (kPoints - 1);
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    const double to_inset = std::min((shell.width / 2 - inset) / std::max(std::abs(out.x()), 1e-6),
                                     (shell.depth / 2 - inset) / std::max(std::abs(out.y()), 1e-6));
    const Eigen::Vector2d eye = out * (to_inset + random.uniform(-0.1, 0.1));
    const double aslant = random.uniform(0.1, 1.2);  // from straight ahead to the wall
    const Eigen::Vector2d ahead = way * Eigen::Vector2d(-out.y(), out.x());
    const Eigen::Vector2d target = eye + 0.8 * (std::cos(aslant) * ahead + std::sin(aslant) * out);
    const double eye_height = height + random.uniform(-0.1, 0.1);
    points.push_back(
        {{eye.x(), eye.y(), eye_height}, {target.x(), target.y(), eye_height - random.uniform(0.1, 0.45)}});
  }
  return alongAtHandsPace(std::move(points));
}

Shell buildRoom(HashStream& random, Layout& layout) {
  const Shell shell{random.uniform(3.2, 4.6), random.uniform(3.2, 4.4)};
  addRandomFloor(random, layout, shell);
  const int walls = random.between(2, 4);
  const int first = random.below(4);
  for (int i = 0; i < walls; ++i) addRandomWall(random, layout, shell, (first + i) % 4);
  for (int i = 0; i < walls; ++i) furnishWall(random, layout, shell, (first + i) % 4);
  Stand floor{{Eigen::Vector2d::Zero(), {shell.width / 2 - 0.1, shell.depth / 2 - 0.1}}, 0};
  if (random.chance(0.65)) {
    Stand middle = floor;
    middle.area.half *= 0.55;
    addIsland(random, layout, middle);
  }
  addFloorClutter(random, layout, floor);
  return shell;
}

/// `hard_seed` as in Layout; `purpose`: of the first room's random numbers.
SceneRecipe makeRoomOf(std::uint32_t seed, std::uint32_t purpose, std::optional<std::uint32_t> hard_seed) {
  SceneRecipe best{.name = "room " + std::to_string(seed), .scene = {}, .path = {}, .frames = 300};
  int fewest_bad = 1000;
  for (std::uint32_t room = 0; room < kRooms && fewest_bad > 0; ++room) {
    HashStream random(seed, purpose + room);
    Layout layout(hard_seed);
    const Shell shell = buildRoom(random, layout);
    CameraPath path;
    int fewest_here = fewest_bad;
    for (int attempt = 0; attempt < kPathsInRoom && fewest_here > 0; ++attempt) {
      CameraPath candidate = makePath(random, shell);
      const int bad = countBadViews(layout, candidate, kRoomSeconds, fewest_here);
      if (bad < fewest_here) {
        fewest_here = bad;
        path = std::move(candidate);
      }
    }
    if (fewest_here < fewest_bad) {
      fewest_bad = fewest_here;
      best.scene = std::move(layout.scene);
      best.path = std::move(path);
    }
  }
  best.lit_center = {0, 0, 0.4};
  best.lit_radius_m = 2.6;
  return best;
}

}  // namespace

SceneRecipe makeRandomRoomScene(std::uint32_t seed) { return makeRoomOf(seed, 1000, std::nullopt); }

SceneRecipe makeHardRoomScene(std::uint32_t seed) {
  SceneRecipe recipe = makeRoomOf(seed, 11000, seed);
  recipe.name = "hard " + recipe.name;
  makeHard(recipe, seed);
  return recipe;
}

SceneRecipe makeRandomSweepScene(std::uint32_t seed) {
  SceneRecipe recipe{
      .name = "sweep " + std::to_string(seed), .scene = {}, .path = {}, .frames = kSweepFrames};
  for (std::uint32_t room = 0; !recipe.path; ++room) {
    HashStream random(seed, 2000 + room);
    Layout layout;
    const Shell shell = buildRoom(random, layout);
    for (int attempt = 0; attempt < kPathsInRoom && !recipe.path; ++attempt) {
      const CameraPath candidate = makeSweep(random, shell, random.uniform(0.8, 1.6));
      if (passesNear(layout, candidate, kSweepSeconds)) recipe.path = candidate;
    }
    if (recipe.path) recipe.scene = std::move(layout.scene);
  }
  recipe.lit_center = {0, 0, 0.4};
  recipe.lit_radius_m = 2.6;
  return recipe;
}

}  // namespace scantrove::synthetic
