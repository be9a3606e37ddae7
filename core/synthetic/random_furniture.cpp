#include "core/synthetic/random_furniture.h"

#include "core/synthetic/curtain.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

/// Builds furniture from boxes; each is a part and a volume.
class Joiner {
 public:
  Joiner(const std::string& name, bool non_convex) : id_(scene_.addInstance(name, false, non_convex)) {}
  /// A box of full `size` with the middle of its foot at `foot`.
  void box(const Vec3& size, const Vec3& foot, double round, const Material& material) {
    addBox(scene_, id_, {}, size, round, material, foot);
    volumes_.push_back({{foot.head<2>(), size.head<2>() / 2}, foot.z(), foot.z() + size.z()});
  }
  /// A small fitting on a front, within the volumes or close to them.
  void knob(const Vec3& size, const Vec3& foot, double round, const Material& material) {
    addBox(scene_, id_, {}, size, round, material, foot);
  }
  void stand(const Vec3& middle, double length, double depth, double headroom = 10) {
    stands_.push_back({{middle.head<2>(), {length / 2, depth / 2}}, middle.z(), headroom});
  }
  [[nodiscard]] Thing finish() {
    Thing thing(std::move(scene_));
    thing.volumes = std::move(volumes_);
    thing.stands = std::move(stands_);
    return thing;
  }

 private:
  SyntheticScene scene_;
  std::uint16_t id_;
  std::vector<Volume> volumes_;
  std::vector<Stand> stands_;
};

/// Slightly raised doors or drawers on a front from `low` to `high`, each with its handle.
void addFronts(Joiner& joiner, HashStream& random, const Vec3& foot, double width, double low, double high,
               const Material& skin) {
  const bool drawers = random.chance(0.5);
  const int rows = drawers ? random.between(2, 4) : 1;
  const int columns = drawers ? (width > 0.9 ? 2 : 1) : std::max(1, static_cast<int>(width / 0.45));
  const Material metal{Pattern::plain, rgb(0x8d8d92), {}, {}, 0.03F, 0.5F};
  const double w = width / columns;
  const double h = (high - low) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3 at(foot.x() + (column + 0.5) * w - width / 2, foot.y(), low + row * h);
      joiner.knob({w - 0.006, 0.016, h - 0.006}, at + Vec3(0, -0.008, 0.003), 0.002, skin);
      const Vec3 handle = drawers ? Vec3(0.12, 0.022, 0.012) : Vec3(0.012, 0.022, 0.12);
      const double aside = drawers ? 0 : (column % 2 == 0 ? 1 : -1) * (w / 2 - 0.04);
      joiner.knob(handle, at + Vec3(aside, -0.027, h / 2 - handle.z() / 2), 0.004, metal);
    }
  }
}

}  // namespace

Thing makeRandomTable(HashStream& random, const Vec3& size) {
  Joiner joiner("table", true);
  const Material skin = randomPaintwork(random);
  const double top = random.uniform(0.02, 0.045);
  const double leg_height = size.z() - top;
  joiner.box({size.x(), size.y(), top}, {0, 0, leg_height}, random.uniform(0.002, 0.01), skin);
  const double thick = random.uniform(0.04, 0.08);
  if (random.chance(0.7)) {
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        joiner.box({thick, thick, leg_height}, {sx * (size.x() / 2 - thick), sy * (size.y() / 2 - thick), 0},
                   0.005, skin);
      }
    }
  } else {  // two side boards
    for (const double s : {-1.0, 1.0}) {
      joiner.box({0.03, size.y() * 0.8, leg_height}, {s * (size.x() / 2 - 0.08), 0, 0}, 0.003, skin);
    }
  }
  joiner.stand({0, 0, size.z()}, size.x() - 0.03, size.y() - 0.03);
  return joiner.finish();
}

Thing makeDesk(HashStream& random, double length) {
  Joiner joiner("desk", true);
  const Material skin = randomPaintwork(random);
  const double depth = random.uniform(0.55, 0.75);
  const double height = random.uniform(0.70, 0.76);
  joiner.box({length, depth, 0.028}, {0, -depth / 2, height - 0.028}, 0.003, skin);
  const double side = random.sign();
  const Vec3 block(side * (length / 2 - 0.23), -depth / 2, 0);
  joiner.box({0.42, depth - 0.06, height - 0.028}, block, 0.003, skin);
  addFronts(joiner, random, {block.x(), -depth + 0.03, 0}, 0.42, 0.06, height - 0.04, skin);
  joiner.box({0.03, depth - 0.04, height - 0.028}, {-side * (length / 2 - 0.03), -depth / 2, 0}, 0.003, skin);
  joiner.stand({0, -depth / 2, height}, length - 0.03, depth - 0.03);
  return joiner.finish();
}

Thing makeCupboard(HashStream& random, const Vec3& size) {
  Joiner joiner(size.z() > 1.2 ? "cupboard" : "chest", false);
  const Material skin = randomPaintwork(random);
  const double plinth = random.uniform(0.0, 0.1);
  const double depth = size.y();
  if (plinth > 0.03) {
    joiner.box({size.x(), depth - 0.05, plinth}, {0, -(depth - 0.05) / 2, 0}, 0.001, skin);
  }
  const double low = plinth > 0.03 ? plinth : 0.0;
  joiner.box({size.x(), depth, size.z() - low}, {0, -depth / 2, low}, 0.003, skin);
  Material fronts = skin;
  if (random.chance(0.3)) fronts.main = randomPaint(random);
  addFronts(joiner, random, {0, -depth, 0}, size.x() - 0.03, low + 0.015, size.z() - 0.015, fronts);
  joiner.stand({0, -depth / 2, size.z()}, size.x() - 0.02, depth - 0.02);
  return std::move(joiner.finish().withSides(0.003));
}

Thing makeBookcase(HashStream& random, const Vec3& size) {
  Joiner joiner("shelf", true);
  const Material skin = randomPaintwork(random);
  const double board = random.uniform(0.016, 0.028);
  const int levels = std::max(2, static_cast<int>(size.z() / random.uniform(0.30, 0.40)));
  const double y = -size.y() / 2;
  for (const double s : {-1.0, 1.0}) {
    joiner.box({board, size.y(), size.z()}, {s * (size.x() - board) / 2, y, 0}, 0.002, skin);
  }
  const double rise = (size.z() - board) / levels;
  for (int level = 0; level <= levels; ++level) {
    joiner.box({size.x(), size.y(), board}, {0, y, level * rise}, 0.002, skin);
    const double headroom = level < levels ? rise - board : 10;
    joiner.stand({0, y - 0.005, level * rise + board}, size.x() - 2 * board - 0.01, size.y() - 0.03,
                 headroom);
  }
  if (random.chance(0.7)) joiner.box({size.x(), 0.008, size.z()}, {0, -0.004, 0}, 0.001, skin);
  return joiner.finish();
}

Thing makeSofa(HashStream& random, double length) {
  Joiner joiner("sofa", true);
  const Material cloth = randomFabric(random);
  const double depth = random.uniform(0.75, 0.9);
  const double seat = random.uniform(0.36, 0.44);
  const double back = random.uniform(0.7, 0.85);
  const double arm = random.uniform(0.12, 0.2);
  joiner.box({length, depth, seat - 0.14}, {0, -depth / 2, 0.0}, 0.02, cloth);
  joiner.box({length, 0.2, back}, {0, -0.1, 0}, 0.06, cloth);
  for (const double s : {-1.0, 1.0}) {
    joiner.box({arm, depth, seat + 0.17}, {s * (length - arm) / 2, -depth / 2, 0}, 0.05, cloth);
  }
  const double inside = length - 2 * arm;
  const int seats = std::max(1, static_cast<int>(std::lround(inside / 0.65)));
  for (int i = 0; i < seats; ++i) {
    joiner.box({inside / seats - 0.004, depth - 0.22, 0.15},
               {(i + 0.5) * inside / seats - inside / 2, -0.2 - (depth - 0.22) / 2, seat - 0.15}, 0.035,
               cloth);
  }
  joiner.stand({0, -0.2 - (depth - 0.22) / 2, seat}, inside - 0.08, depth - 0.3);
  return joiner.finish();
}

Thing makeBed(HashStream& random, double length) {
  Joiner joiner("bed", true);
  const Material frame = randomPaintwork(random);
  const double width = random.uniform(0.85, 1.1);
  joiner.box({length, width, 0.28}, {0, -width / 2, 0}, 0.006, frame);
  joiner.box({0.04, width, random.uniform(0.6, 0.95)}, {-length / 2 + 0.02, -width / 2, 0}, 0.006, frame);
  joiner.box({length - 0.08, width - 0.04, 0.2}, {0.02, -width / 2, 0.28}, 0.06, randomFabric(random));
  joiner.stand({0.02, -width / 2, 0.48}, length - 0.24, width - 0.2);
  return joiner.finish();
}

Thing makePillar(HashStream& random) {
  Joiner joiner("pillar", false);
  const Material paint{Pattern::plaster, randomPaint(random), {}, {}, 0.03F, 0, false, random.bits()};
  const double width = random.uniform(0.22, 0.45);
  const double depth = random.uniform(0.12, 0.4);
  const double round = random.chance(0.5) ? 0.0 : 0.02;
  joiner.box({width, depth, 2.5}, {0, -depth / 2, 0}, round, paint);
  return std::move(joiner.finish().withSides(round));
}

Thing makeDoor(HashStream& random) {
  Joiner joiner("door", true);
  Material wood = randomPaintwork(random);
  wood.casts_shadow = false;
  const Material metal{Pattern::plain, rgb(0x8d8d92), {}, {}, 0.03F, 0.5F};
  const double width = random.uniform(0.75, 0.95);
  const double frame = random.uniform(0.06, 0.1);
  const double proud = random.uniform(0.03, 0.06);
  for (const double s : {-1.0, 1.0}) {
    joiner.box({frame, proud, 2.1}, {s * (width + frame) / 2, -proud / 2, 0}, 0.004, wood);
  }
  joiner.box({width + 2 * frame, proud, frame}, {0, -proud / 2, 2.1}, 0.004, wood);
  const double side = random.sign();
  joiner.box({width, 0.012, 2.1}, {0, -0.006, 0}, 0.0, wood);
  joiner.knob({0.12, 0.03, 0.02}, {side * (width / 2 - 0.1), -0.027, 1.02}, 0.008, metal);
  return joiner.finish();
}

Thing makeCurtain(HashStream& random, double length) {
  SyntheticScene scene;
  const auto id = scene.addInstance("curtain", false, true);
  Material cloth = randomFabric(random);
  cloth.casts_shadow = false;
  const double depth = random.uniform(0.07, 0.12);
  const double low = random.uniform(0.0, 0.05);
  const double high = random.uniform(2.1, 2.4);
  addPart(
      scene, id, {},
      std::make_unique<Curtain>(Vec3(length, depth, high - low), 0.004, length / random.uniform(0.11, 0.2)),
      cloth, {0, -depth / 2 - 0.01, (low + high) / 2});
  Thing curtain(std::move(scene));
  for (SyntheticScene::Part& part : curtain.parts) part.T_world_part.pretranslate(Vec3(0, 0, low));
  curtain.volumes.front().z_high = high;
  return curtain;
}

Thing makeRug(HashStream& random) {
  SyntheticScene scene;
  Material cloth = randomFabric(random);
  cloth.pattern = Pattern::weave;
  const Vec3 size{random.uniform(0.9, 2.0), random.uniform(0.6, 1.4), random.uniform(0.005, 0.014)};
  addBox(scene, scene.addInstance("rug", false), {}, size, 0.004, cloth);
  return std::move(Thing(std::move(scene)).withTop(0.02));
}

}  // namespace scantrove::synthetic
