#include <cmath>
#include <numbers>
#include <optional>

#include "core/synthetic/camera_work.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/random_furniture.h"
#include "core/synthetic/random_things.h"
#include "core/synthetic/random_walls.h"
#include "core/synthetic/scene_recipe.h"
#include "core/synthetic/table_settings.h"

namespace scantrove::synthetic {
namespace {

constexpr double kTableSeconds = 8;    // 240 frames
constexpr int kTables = 12;            // tables to try until one has good camera paths
constexpr int kPathsAroundTable = 30;  // tried around each

/// Circles the table's centre at varying distance and height.
CameraPath makePath(HashStream& random, const Stand& top) {
  const double first = random.uniform(0, 2 * std::numbers::pi);
  const double sweep = random.sign() * random.uniform(1.7, 3.0);
  const double radius = random.uniform(0.7, 1.05);
  const double rise = random.uniform(0.35, 0.75);
  constexpr int kPoints = 9;
  std::vector<Gaze> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = first + sweep * i / (kPoints - 1);
    const double away = radius + random.uniform(-0.1, 0.1);
    const double above = rise + random.uniform(-0.1, 0.1);
    const Vec3 aside{random.uniform(-0.1, 0.1), random.uniform(-0.08, 0.08), random.uniform(0.0, 0.1)};
    const Vec3 middle(top.area.center.x(), top.area.center.y(), top.z);
    points.push_back({middle + Vec3(away * std::cos(angle), away * std::sin(angle), above), middle + aside});
  }
  return alongAtHandsPace(std::move(points));
}

/// A table in a room with two walls; the stand is its top.
Stand buildTable(HashStream& random, Layout& layout) {
  const Shell shell{random.uniform(3.0, 4.2), random.uniform(3.0, 4.2)};
  addRandomFloor(random, layout, shell);
  const int first = random.below(4);
  for (int i = 0; i < 2; ++i) addRandomWall(random, layout, shell, (first + i) % 4);
  Thing table = makeRandomTable(
      random, {random.uniform(0.9, 1.4), random.uniform(0.65, 0.9), random.uniform(0.68, 0.78)});
  const double half_y = table.stands.front().area.half.y() + 0.03;
  const double back = random.chance(0.4) ? shell.wallLength((first + 1) % 4) / 2 - half_y - kSkirting_m : 0.0;
  const Place wall = shell.wallPlace(first);
  const Eigen::Vector2d at = Footprint{{random.uniform(-0.4, 0.4), back}}.placedAt(0, 0, wall.yaw_deg).center;
  layout.put(table, at.x(), at.y(), 0, wall.yaw_deg);
  const Stand bare = layout.newStands().front();
  const Stand top = layout.isHard() ? spreadCloth(random, layout, bare) : bare;
  Stand used = top;
  used.area.half = used.area.half.cwiseMin(Eigen::Vector2d(0.5, 0.4));
  layout.clutter(random, used, random.between(10, 18));
  for (int i = random.between(0, 3); i > 0 && !layout.faces().empty(); --i) {
    const auto faces = static_cast<int>(layout.faces().size());
    Face face = layout.faces()[static_cast<std::size_t>(random.below(faces))];
    if (face.z > 0.5) layout.lean(random, face);
  }
  const Stand floor{{Eigen::Vector2d::Zero(), {shell.width / 2 - 0.1, shell.depth / 2 - 0.1}}, 0};
  if (layout.isHard()) placeChairsAt(random, layout, bare, random.between(0, 2));
  for (int i = 0; i < 2; ++i) furnishWall(random, layout, shell, (first + i) % 4);
  for (int i = random.between(1, 4); i > 0; --i) {
    Thing thing = layout.drawFloorThing(random);
    layout.placeOn(random, floor, thing);
  }
  return top;
}

/// `hard_seed` as in Layout; `purpose`: of the first table's random numbers.
SceneRecipe makeTabletopOf(std::uint32_t seed, std::uint32_t purpose,
                           std::optional<std::uint32_t> hard_seed) {
  SceneRecipe best{.name = "tabletop " + std::to_string(seed), .scene = {}, .path = {}, .frames = 240};
  int fewest_bad = 1000;
  for (std::uint32_t table = 0; table < kTables && fewest_bad > 0; ++table) {
    HashStream random(seed, purpose + table);
    Layout layout(hard_seed);
    const Stand top = buildTable(random, layout);
    CameraPath path;
    int fewest_here = fewest_bad;
    for (int attempt = 0; attempt < kPathsAroundTable && fewest_here > 0; ++attempt) {
      CameraPath candidate = makePath(random, top);
      const int bad = countBadViews(layout, candidate, kTableSeconds, fewest_here);
      if (bad < fewest_here) {
        fewest_here = bad;
        path = std::move(candidate);
      }
    }
    if (fewest_here < fewest_bad) {
      fewest_bad = fewest_here;
      best.lit_center = {top.area.center.x(), top.area.center.y(), 0.4};
      best.scene = std::move(layout.scene);
      best.path = std::move(path);
    }
  }
  best.lit_radius_m = 1.8;
  return best;
}

}  // namespace

SceneRecipe makeRandomTabletopScene(std::uint32_t seed) { return makeTabletopOf(seed, 2000, std::nullopt); }

SceneRecipe makeHardTabletopScene(std::uint32_t seed) {
  SceneRecipe recipe = makeTabletopOf(seed, 12000, seed);
  recipe.name = "hard " + recipe.name;
  makeHard(recipe, seed);
  return recipe;
}

}  // namespace scantrove::synthetic
