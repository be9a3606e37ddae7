#include "core/synthetic/random_walls.h"

#include <algorithm>

#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/random_boxes.h"
#include "core/synthetic/random_furniture.h"
#include "core/synthetic/random_things.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

constexpr double kWallHeight_m = 2.5;

/// Transforms a point from a wall's frame to the room.
Eigen::Vector2d inRoom(const Place& wall, double along, double into) {
  return Footprint{{along, into}}.placedAt(wall.x, wall.y, wall.yaw_deg).center;
}

Thing makeWallPiece(HashStream& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.20)
    return makeCupboard(random,
                        {random.uniform(0.5, 1.6), random.uniform(0.35, 0.6), random.uniform(0.5, 1.0)});
  if (kind < 0.28)
    return makeCupboard(random,
                        {random.uniform(0.6, 1.2), random.uniform(0.4, 0.6), random.uniform(1.6, 2.1)});
  if (kind < 0.50)
    return makeBookcase(random,
                        {random.uniform(0.6, 1.3), random.uniform(0.24, 0.38), random.uniform(0.7, 1.9)});
  if (kind < 0.65) return makeDesk(random, random.uniform(1.1, 1.6));
  if (kind < 0.75) return makeSofa(random, random.uniform(1.0, 1.9));
  if (kind < 0.79) return makeBed(random, random.uniform(1.8, 2.0));
  if (kind < 0.86) return makePillar(random);
  if (kind < 0.93) return makeCurtain(random, random.uniform(0.6, 1.5));
  return makeDoor(random);
}

void fillStand(HashStream& random, Layout& layout, const Stand& stand) {
  const double area = 4 * stand.area.half.x() * stand.area.half.y();
  const bool shelf = stand.headroom_m < 1;
  if (stand.z > 1.9 || (stand.z < 0.2 && !shelf)) return;
  if (shelf && random.chance(0.45)) {
    layout.fillWithBooks(random, stand, random.between(3, 12));
    layout.clutter(random, stand, random.between(0, 2));
    return;
  }
  if (!shelf && area > 0.6 && random.chance(0.4)) {
    Thing monitor = makeRandomMonitor(random);
    layout.placeOn(random, stand, monitor);
  }
  layout.clutter(random, stand, std::clamp(static_cast<int>(area * random.uniform(9, 20)), 1, 10));
}

/// Cushions on sofas and beds lie flat: leaning ones would have to bend.
void fillSeat(HashStream& random, Layout& layout, const Stand& stand) {
  for (int i = random.between(1, 5); i > 0; --i) {
    Thing thing = random.chance(0.6) ? makeRandomCushion(random) : makeStackable(random);
    layout.placeOn(random, stand, thing);
  }
}

void hangPicture(HashStream& random, Layout& layout, const Shell& shell, int wall) {
  SyntheticScene scene;
  const Vec3 size{random.uniform(0.3, 0.9), random.uniform(0.015, 0.035), random.uniform(0.3, 0.7)};
  addBox(scene, scene.addInstance("picture", false), {}, size, 0.004, randomPrint(random, Pattern::picture),
         {0, -size.y() / 2, 0});
  Thing picture(std::move(scene));
  const double room = shell.wallLength(wall) / 2 - size.x();
  const double height = random.uniform(1.0, 1.5);
  const Place place = shell.wallPlace(wall);
  const Eigen::Vector2d at = inRoom(place, random.uniform(-room, room), 0);
  layout.put(picture, at.x(), at.y(), height, place.yaw_deg);
}

void hangBoard(HashStream& random, Layout& layout, const Shell& shell, int wall) {
  SyntheticScene scene;
  const Vec3 size{random.uniform(0.5, 1.1), random.uniform(0.18, 0.28), 0.025};
  addBox(scene, scene.addInstance("wall shelf", false), {}, size, 0.002, randomPaintwork(random),
         {0, -size.y() / 2, 0});
  Thing board = std::move(Thing(std::move(scene)).withTop(0.01));
  const double room = shell.wallLength(wall) / 2 - size.x() / 2;
  const Place place = shell.wallPlace(wall);
  const Eigen::Vector2d at = inRoom(place, random.uniform(-room, room), 0);
  if (layout.put(board, at.x(), at.y(), random.uniform(1.1, 1.5), place.yaw_deg)) {
    const Stand top = layout.newStands().front();
    layout.clutter(random, top, random.between(2, 5));
  }
}

}  // namespace

Place Shell::wallPlace(int wall) const {
  switch (wall) {
    case 0:
      return {0, depth / 2, 0, 0};
    case 1:
      return {width / 2, 0, 0, -90};
    case 2:
      return {0, -depth / 2, 0, 180};
    default:
      return {-width / 2, 0, 0, 90};
  }
}

void addRandomFloor(HashStream& random, Layout& layout, const Shell& shell) {
  Material skin = randomWood(random);
  skin.pattern = random.pick({Pattern::planks, Pattern::planks, Pattern::tiles, Pattern::speckle});
  skin.scale = static_cast<float>(skin.pattern == Pattern::tiles ? random.uniform(0.2, 0.45)
                                                                 : random.uniform(0.09, 0.16));
  if (skin.pattern != Pattern::planks) {
    skin.main = randomPaint(random) * 0.8F;
    skin.second = skin.main * 0.7F;
  }
  if (skin.pattern == Pattern::speckle) skin.scale = 0.02F;
  const Vec3 size(shell.width + 0.6, shell.depth + 0.6, 0.1);
  const auto id = layout.scene.addInstance("floor", false);
  addBox(layout.scene, id, {}, size, 0, skin, {0, 0, -0.1});
  layout.fill({{Eigen::Vector2d::Zero(), size.head<2>() / 2}, -0.1, 0}, id);
}

void addRandomWall(HashStream& random, Layout& layout, const Shell& shell, int wall) {
  static const char* const kNames[] = {"wall, back", "wall, right", "wall, front", "wall, left"};
  const auto id = layout.scene.addInstance(kNames[wall], false);
  const Place place = shell.wallPlace(wall);
  const double length = shell.wallLength(wall);
  Material paint{Pattern::plaster, randomPaint(random), {}, {}, 0.03F, 0, false, random.bits()};
  addBox(layout.scene, id, place, {length + 0.2, 0.1, kWallHeight_m}, 0, paint, {0, 0.05, 0});
  const Eigen::Vector2d middle = inRoom(place, 0, 0.05);
  layout.fill({{middle, {length / 2 + 0.1, 0.05}, place.yaw_deg}, 0, kWallHeight_m}, id);
  layout.addFace({{place.x, place.y}, place.yaw_deg, length - 0.3, 0, kWallHeight_m, 0, id});
  if (random.chance(0.7)) {
    Material skirting{Pattern::plain, randomPaint(random)};
    skirting.casts_shadow = false;
    addBox(layout.scene, id, place, {length, kSkirting_m, random.uniform(0.05, 0.1)}, 0.002, skirting,
           {0, -kSkirting_m / 2, 0});
  }
}

void furnishWall(HashStream& random, Layout& layout, const Shell& shell, int wall) {
  const Place place = shell.wallPlace(wall);
  const double end = shell.wallLength(wall) / 2;
  double along = -end + random.uniform(0, 0.3);
  for (int tries = 0; along < end - 0.3 && tries < 40; ++tries) {
    Thing piece = makeWallPiece(random);
    const std::string kind = piece.who.name;
    double half = 0;
    for (const Volume& volume : piece.volumes) {
      half = std::max(half, std::abs(volume.base.center.x()) + volume.base.half.x());
    }
    const double back = kind == "pillar" ? 0 : -kSkirting_m;
    const Eigen::Vector2d at = inRoom(place, along + half, back);
    if (along + 2 * half > end || !layout.put(piece, at.x(), at.y(), 0, place.yaw_deg)) {
      along += 0.08;
      continue;
    }
    along += 2 * half + (random.chance(0.35) ? 1e-6 : random.uniform(0.04, 0.5));
    const std::vector<Stand> stands = layout.newStands();
    for (const Stand& stand : stands) {
      if (kind == "sofa" || kind == "bed") {
        fillSeat(random, layout, stand);
      } else {
        fillStand(random, layout, stand);
      }
    }
  }
  for (int i = random.between(0, 2); i > 0; --i) hangPicture(random, layout, shell, wall);
  if (random.chance(0.6)) hangBoard(random, layout, shell, wall);
}

}  // namespace scantrove::synthetic
