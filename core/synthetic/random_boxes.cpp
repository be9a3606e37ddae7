#include "core/synthetic/random_boxes.h"

#include <numbers>

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {

Thing makeRandomCarton(HashStream& random, double low_m, double high_m) {
  SyntheticScene scene;
  const Vec3 size{random.uniform(low_m, high_m), random.uniform(low_m, high_m),
                  random.uniform(low_m, high_m)};
  const auto print = random.chance(0.6) ? randomPrint(random, Pattern::boxLabel) : randomGlaze(random);
  addBox(scene, scene.addInstance("box", true), {}, size, 0.002, print);
  return std::move(Thing(std::move(scene)).withTop(0.002).withSides(0.002));
}

Thing makeRandomBook(HashStream& random) {
  SyntheticScene scene;
  const Vec3 size{random.uniform(0.11, 0.22), random.uniform(0.16, 0.30), random.uniform(0.010, 0.05)};
  addBook(scene, "book", {}, size, randomPrint(random, Pattern::bookCover));
  return std::move(Thing(std::move(scene)).withTop(0.002));
}

Thing makeUprightBook(HashStream& random) {
  SyntheticScene scene;
  const Vec3 size{random.uniform(0.11, 0.2), random.uniform(0.16, 0.27), random.uniform(0.012, 0.055)};
  addBook(scene, "book", {}, size, randomPrint(random, Pattern::bookCover), true);
  return Thing(std::move(scene));
}

Thing makeRandomBlocks(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("block", true, true);
  Material skin = random.chance(0.5) ? randomWood(random) : randomGlaze(random);
  const double a = random.uniform(0.035, 0.06);  // thickness
  const double length = random.uniform(0.12, 0.22);
  const double depth = random.uniform(0.05, 0.12);
  const double height = random.uniform(0.09, 0.2);
  const double round = random.uniform(0.001, 0.006);
  switch (random.below(4)) {
    case 0:  // L
      addBox(scene, id, {}, {length, depth, a}, round, skin);
      addBox(scene, id, {}, {a, depth, height}, round, skin, {(a - length) / 2, 0, 0});
      break;
    case 1:  // T on its head
      addBox(scene, id, {}, {length, depth, a}, round, skin);
      addBox(scene, id, {}, {a, depth, height}, round, skin);
      break;
    case 2:  // U
      addBox(scene, id, {}, {length, depth, a}, round, skin);
      for (const double s : {-1.0, 1.0}) {
        addBox(scene, id, {}, {a, depth, height}, round, skin, {s * (length - a) / 2, 0, 0});
      }
      break;
    default:  // stairs
      for (int step = 0; step < 3; ++step) {
        addBox(scene, id, {}, {length * (3 - step) / 3, depth, height / 3 * (step + 1)}, round, skin,
               {length * step / 6, 0, 0});
      }
  }
  return Thing(std::move(scene));
}

Thing makeRandomLaptop(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("laptop", true, true);
  const Material shell{Pattern::plain, randomPaint(random) * 0.6F};
  const double width = random.uniform(0.28, 0.38);
  const double depth = width * random.uniform(0.62, 0.7);
  addBox(scene, id, {}, {width, depth, 0.018}, 0.004, shell);
  const double opened = random.uniform(5, 35);
  const Eigen::Matrix3d lean = turned(-opened, Vec3::UnitX());
  const Vec3 hinge(0, depth / 2 - 0.006, 0.012);
  addPart(scene, id, {}, std::make_unique<RoundedBox>(Vec3(width / 2, 0.004, depth / 2), 0.003), shell,
          hinge + lean * Vec3(0, 0, depth / 2), lean);
  return Thing(std::move(scene));
}

Thing makeRandomMonitor(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("monitor", true, true);
  const Material shell{Pattern::plain, randomPaint(random) * 0.3F};
  const double width = random.uniform(0.42, 0.62);
  const double height = width * random.uniform(0.56, 0.62);
  addBox(scene, id, {}, {0.24, 0.18, 0.015}, 0.004, shell);
  addBox(scene, id, {}, {0.06, 0.03, 0.13 + height / 2}, 0.004, shell, {0, 0.03, 0});
  addBox(scene, id, {}, {width, 0.035, height}, 0.006, shell, {0, 0, 0.11});
  return Thing(std::move(scene));
}

Thing makeRandomShoe(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("shoe", true, true);
  const Material skin = randomFabric(random);
  const double length = random.uniform(0.22, 0.31);
  const double width = length * 0.34;
  addBox(scene, id, {}, {length, width, 0.025}, 0.012, {Pattern::plain, randomPaint(random)});
  addBox(scene, id, {}, {length * 0.96, width * 0.94, 0.062}, 0.028, skin, {0, 0, 0.01});
  addBox(scene, id, {}, {length * 0.48, width * 0.9, random.uniform(0.09, 0.2)}, 0.028, skin,
         {-length * 0.23, 0, 0.01});
  return Thing(std::move(scene));
}

Thing makeRandomCushion(HashStream& random) {
  SyntheticScene scene;
  const double side = random.uniform(0.34, 0.46);
  const double thickness = random.uniform(0.10, 0.15);
  addBox(scene, scene.addInstance("cushion", true), {}, {side, side, thickness}, thickness * 0.48,
         randomFabric(random));
  return Thing(std::move(scene));
}

Thing makeRandomSuitcase(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance(random.pick({"suitcase", "bag", "case"}), true, true);
  const Material skin = randomFabric(random);
  const double width = random.uniform(0.3, 0.5);
  const double depth = random.uniform(0.14, 0.24);
  const double height = random.uniform(0.26, 0.6);
  addBox(scene, id, {}, {width, depth, height}, random.uniform(0.02, 0.05), skin);
  addPart(scene, id, {}, std::make_unique<Torus>(0.06, 0.011, 0.0), skin, {0, 0, height - 0.005},
          turned(90, Vec3::UnitX()));
  return Thing(std::move(scene));
}

Thing makeLeaning(HashStream& random, double wall_height_m, double edge_m) {
  SyntheticScene scene;
  // Top view: c is half the length, b half the thickness, a half the width; `t` off the vertical.
  const bool pole = wall_height_m > 1 && random.chance(0.3);
  const double longest = std::min(wall_height_m * 1.5, pole ? 1.5 : 0.7);
  const double c = longest * random.uniform(pole ? 0.8 : 0.45, 1.0) / 2;
  const double a = pole ? random.uniform(0.012, 0.025) : c * random.uniform(0.5, 1.3);
  const double b = pole ? a : random.uniform(0.004, 0.018);
  const double r = b * 0.3;
  const double t = random.uniform(9, 22) / 180 * std::numbers::pi;
  const double zc = (b - r) * std::sin(t) + (c - r) * std::cos(t) + r;
  double yc = -((b - r) * std::cos(t) + (c - r) * std::sin(t) + r);  // its upper edge touches the wall
  if (zc - (b - r) * std::sin(t) + (c - r) * std::cos(t) > wall_height_m - edge_m) {
    // Its back touches the wall's upper edge, a cylinder around (edge, height - edge).
    const double rise = wall_height_m - edge_m - zc;
    yc = edge_m - (b + edge_m + rise * std::sin(t)) / std::cos(t);
  }
  Material skin = random.chance(0.4) ? randomWood(random) : randomPrint(random, Pattern::picture);
  if (!pole && skin.pattern == Pattern::picture) skin.second = randomColor(random);
  addPart(scene, scene.addInstance(pole ? "pole" : "board", true), {},
          std::make_unique<RoundedBox>(Vec3(a, b, c), r), skin, {0, yc, zc},
          turned(-t * 180 / std::numbers::pi, Vec3::UnitX()));
  return Thing(std::move(scene));
}

Thing makeContainer(HashStream& random) {
  SyntheticScene scene;
  const bool tray = random.chance(0.5);
  const auto id = scene.addInstance(tray ? "tray" : "open box", true, true);
  const Material skin = tray ? randomPaintwork(random) : Material{Pattern::plain, rgb(0xb48a5a)};
  const Vec3 size{random.uniform(0.28, 0.42), random.uniform(0.2, 0.3),
                  tray ? random.uniform(0.025, 0.045) : random.uniform(0.09, 0.16)};
  const double wall = tray ? 0.009 : 0.006;
  addBox(scene, id, {}, {size.x(), size.y(), wall}, 0.001, skin);
  std::vector<Volume> volumes{{{Eigen::Vector2d::Zero(), size.head<2>() / 2}, 0, wall}};
  const auto side = [&](const Vec3& extent, double x, double y) {
    addBox(scene, id, {}, extent, 0.001, skin, {x, y, 0});
    volumes.push_back({{{x, y}, extent.head<2>() / 2}, 0, extent.z()});
  };
  for (const double s : {-1.0, 1.0}) {
    side({wall, size.y(), size.z()}, s * (size.x() - wall) / 2, 0);
    side({size.x(), wall, size.z()}, 0, s * (size.y() - wall) / 2);
  }
  Thing container(std::move(scene));
  container.volumes = volumes;
  container.stands = {{{Eigen::Vector2d::Zero(), size.head<2>().array() / 2 - wall - 0.002}, wall}};
  return container;
}

}  // namespace scantrove::synthetic
