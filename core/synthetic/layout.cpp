#include "core/synthetic/layout.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numbers>

#include "core/synthetic/flat_things.h"
#include "core/synthetic/hard_materials.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/random_boxes.h"
#include "core/synthetic/random_chairs.h"
#include "core/synthetic/random_things.h"

namespace scantrove::synthetic {
namespace {

constexpr double kContact_m = 1e-5;               // touching distance
constexpr std::uint32_t kHardMaterials = 20000U;  // purpose of the random numbers of the first instance

std::vector<Volume> placedAt(const std::vector<Volume>& volumes, double x, double y, double z,
                             double yaw_deg) {
  std::vector<Volume> placed;
  placed.reserve(volumes.size());
  for (const Volume& volume : volumes) placed.push_back(volume.placedAt(x, y, z, yaw_deg));
  return placed;
}

/// Most of the contact area lies on the stand; a sixth may overhang.
bool rests(const Stand& stand, const std::vector<Volume>& volumes) {
  return std::all_of(volumes.begin(), volumes.end(), [&](const Volume& volume) {
    Footprint core = volume.base;
    core.half *= 0.85;
    core.round *= 0.85;
    return contains(stand.area, core);
  });
}

}  // namespace

double Layout::clearance(const std::vector<Volume>& volumes, std::uint16_t beside) const {
  double nearest = kNoHit;
  for (const Volume& volume : volumes) {
    for (const Filled& other : filled_) {
      if (other.instance != beside && volume.overlapsInHeight(other.volume)) {
        nearest = std::min(nearest, distance(volume.base, other.volume.base));
      }
    }
  }
  return nearest;
}

std::string Layout::freeName(const std::string& name) const {
  std::string free = name;
  for (int number = 2; scene.find(free) != 0; ++number) free = fmt::format("{} {}", name, number);
  return free;
}

bool Layout::put(Thing& thing, double x, double y, double z, double yaw_deg, std::uint16_t beside) {
  const std::vector<Volume> volumes = placedAt(thing.volumes, x, y, z, yaw_deg);
  if (clearance(volumes, beside) < -1e-9) return false;
  const auto id = scene.addInstance(freeName(thing.who.name), thing.who.is_object, thing.who.non_convex);
  if (hard_seed_) giveHardMaterials(HashStream(*hard_seed_, kHardMaterials + id), thing);
  const Eigen::Isometry3d T_world_thing = Place{x, y, z, yaw_deg}.pose();
  for (SyntheticScene::Part& part : thing.parts) {
    scene.add(id, std::move(part.shape), T_world_thing * part.T_world_part, part.material);
  }
  for (const Volume& volume : volumes) filled_.push_back({volume, id});
  new_stands_.clear();
  for (const Stand& stand : thing.stands) {
    new_stands_.push_back({stand.area.placedAt(x, y, yaw_deg), stand.z + z, stand.headroom_m});
  }
  if (thing.side_round_m >= 0) {
    const Volume& body = volumes.back();
    for (const double side : {-1.0, 1.0}) {
      const double yaw = body.base.yaw_deg + side * 90;
      const Footprint foot = Footprint{{side * body.base.half.x(), 0}}.placedAt(0, 0, body.base.yaw_deg);
      faces_.push_back({body.base.center + foot.center, yaw, 2 * body.base.half.y(), z, body.z_high - z,
                        thing.side_round_m, id});
    }
  }
  return true;
}

Eigen::Vector2d Layout::slideUpTo(HashStream& random, const Stand& stand, const Thing& thing,
                                  const Eigen::Vector2d& from, double yaw_deg) const {
  constexpr double kFarthest_m = 0.8;
  std::vector<Eigen::Vector2d> neighbors;
  for (const Filled& other : filled_) {
    const bool beside = other.volume.z_low < stand.z + 0.02 && other.volume.z_high > stand.z + 0.02;
    if (beside && (other.volume.base.center - from).norm() < kFarthest_m) {
      neighbors.push_back(other.volume.base.center);
    }
  }
  if (neighbors.empty()) return from;
  const auto count = static_cast<int>(neighbors.size());
  const Eigen::Vector2d step = (neighbors[static_cast<std::size_t>(random.below(count))] - from).normalized();
  for (double moved = 0; moved < kFarthest_m;) {
    Eigen::Vector2d there = from + moved * step;
    const double room = clearance(placedAt(thing.volumes, there.x(), there.y(), stand.z, yaw_deg), 0);
    if (room < kContact_m) return there;
    moved += room - kContact_m / 2;
  }
  return from;
}

bool Layout::placeOn(HashStream& random, const Stand& stand, Thing& thing) {
  if (thing.height() > stand.headroom_m - 0.005) return false;
  const Eigen::Vector2d half = stand.area.half;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const double along = random.uniform(-half.x(), half.x());
    const double across = random.uniform(-half.y(), half.y());
    const double yaw = stand.area.yaw_deg + (random.chance(0.4) ? random.uniform(0, 360)
                                                                : random.pick({0.0, 90.0, 180.0, 270.0}) +
                                                                      random.uniform(-12, 12));
    Eigen::Vector2d at = Footprint{{along, across}}
                             .placedAt(stand.area.center.x(), stand.area.center.y(), stand.area.yaw_deg)
                             .center;
    if (clearance(placedAt(thing.volumes, at.x(), at.y(), stand.z, yaw), 0) < 0.004) continue;
    if (random.chance(0.6)) at = slideUpTo(random, stand, thing, at, yaw);
    if (rests(stand, placedAt(thing.volumes, at.x(), at.y(), stand.z, yaw)) &&
        put(thing, at.x(), at.y(), stand.z, yaw)) {
      return true;
    }
  }
  return false;
}

bool Layout::lean(HashStream& random, const Face& face) {
  Thing board = makeLeaning(random, face.height_m, face.edge_m);
  const double room = face.length_m / 2 - board.volumes.front().base.half.x();
  if (room < 0) return false;
  const Footprint foot =
      Footprint{{random.uniform(-room, room), 0}}.placedAt(face.at.x(), face.at.y(), face.yaw_deg);
  return put(board, foot.center.x(), foot.center.y(), face.z, face.yaw_deg, face.instance);
}

void Layout::fillWithBooks(HashStream& random, const Stand& stand, int count) {
  double x = -stand.area.half.x() + random.uniform(0.0, 0.1);
  for (int i = 0; i < count; ++i) {
    Thing book = makeUprightBook(random);
    const double thickness = 2 * book.volumes.front().base.half.x();
    const double depth = book.volumes.front().base.half.y();
    if (x + thickness > stand.area.half.x() || depth > stand.area.half.y() ||
        book.height() > stand.headroom_m - 0.005) {
      return;
    }
    const Footprint at = Footprint{{x + thickness / 2, stand.area.half.y() - depth}}.placedAt(
        stand.area.center.x(), stand.area.center.y(), stand.area.yaw_deg);
    put(book, at.center.x(), at.center.y(), stand.z, stand.area.yaw_deg);
    x += thickness + 1e-6;
  }
}

void Layout::stack(HashStream& random, const Stand& stand, int count) {
  Stand top = stand;
  for (int i = 0; i < count; ++i) {
    Thing thing = i + 1 < count ? drawStackable(random) : makeSmallThing(random);
    if (!placeOn(random, top, thing) || new_stands_.empty()) return;
    top = new_stands_.front();
  }
}

void Layout::layFlat(HashStream& random, const Stand& stand, int count) {
  for (int i = 0; i < count; ++i) {
    Thing flat = makeRandomFlatThing(random);
    if (!placeOn(random, stand, flat) || new_stands_.empty() || !random.chance(0.3)) continue;
    const Stand top = new_stands_.front();
    Thing thing = makeSmallThing(random);
    placeOn(random, top, thing);
  }
}

Thing Layout::drawStackable(HashStream& random) const {
  return isHard() && random.chance(0.3) ? makeFlatStackable(random) : makeStackable(random);
}

Thing Layout::drawFloorThing(HashStream& random) const {
  Thing thing = makeFloorThing(random);
  return isHard() && thing.who.name == "chair" ? makeRandomChair(random) : std::move(thing);
}

void Layout::clutter(HashStream& random, const Stand& stand, int count) {
  if (isHard()) layFlat(random, stand, stand.headroom_m < 1 ? 1 : (count + 1) / 2);
  for (int i = 0; i < count; ++i) {
    const double kind = random.uniform(0, 1);
    if (kind < 0.08) {
      Thing container = makeContainer(random);
      if (placeOn(random, stand, container)) {
        const Stand inside = new_stands_.front();
        for (int k = random.between(1, 4); k > 0; --k) {
          Thing thing = makeSmallThing(random);
          placeOn(random, inside, thing);
        }
      }
    } else if (kind < 0.35) {
      stack(random, stand, random.between(2, 4));
    } else {
      Thing thing = makeSmallThing(random);
      placeOn(random, stand, thing);
    }
  }
}

}  // namespace scantrove::synthetic
