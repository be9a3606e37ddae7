#include "core/synthetic/flat_things.h"

#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/hard_materials.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {
namespace {

constexpr double kSheetRim_m = 0.002;

/// A box with a printed upper face.
Thing sheet(const std::string& name, const Vec3& size, double radius, const Material& material) {
  SyntheticScene scene;
  addBox(scene, scene.addInstance(name, true), {}, size, radius, material);
  return Thing(std::move(scene));
}

/// Cutlery of steel, or of coloured plastics.
Material cutlery(HashStream& random) {
  if (random.chance(0.7)) return randomMetal(random);
  Material plastic{Pattern::plain, randomColor(random)};
  plastic.gloss = static_cast<float>(random.uniform(0, 0.3));
  return plastic;
}

/// Builds one piece of cutlery from boxes that lie one behind the other along y.
class Smith {
 public:
  Smith(const std::string& name, const Material& material)
      : id_(scene_.addInstance(name, true, true)), material_(material) {}
  void bar(double x, double length, double width, double height) {
    addBox(scene_, id_, {}, {width, length, height}, 0.4 * height, material_, {x, at_ + length / 2, 0});
  }
  void goOn(double length) { at_ += length; }
  /// A round shallow bowl.
  void bowl(double radius) {
    addPart(scene_, id_, {},
            std::make_unique<Lathe>(Lathe::Profile{{0, 0},
                                                   {0.6 * radius, 0},
                                                   {radius, 0.006},
                                                   {0.93 * radius, 0.006},
                                                   {0.5 * radius, 0.002},
                                                   {0, 0.002}}),
            material_, {0, at_ + 0.9 * radius, 0});
  }
  [[nodiscard]] Thing finish() { return Thing(std::move(scene_)); }

 private:
  SyntheticScene scene_;
  std::uint16_t id_;
  Material material_;
  double at_ = 0;  // along y
};

}  // namespace

Thing makeRandomPaper(HashStream& random) {
  const double format = random.pick({0.297, 0.297, 0.210, 0.148});
  const double sheets = random.chance(0.6) ? 0.0004 : random.uniform(0.0008, 0.004);
  Material paper{Pattern::page, random.chance(0.8) ? Rgb(Rgb::Constant(0.88F)) : randomPaint(random)};
  paper.second = randomColor(random);
  paper.third = randomColor(random);
  paper.seed = random.bits();
  Thing thing = sheet("paper", {format / 1.414, format, sheets}, 0, paper);
  return std::move(thing.withTop(kSheetRim_m));
}

Thing makeRandomMagazine(HashStream& random) {
  const bool is_open = random.chance(0.35);
  const Vec3 size{random.uniform(0.19, 0.23) * (is_open ? 2 : 1), random.uniform(0.26, 0.3),
                  random.uniform(0.002, 0.007)};
  Material print = randomPrint(random, is_open ? Pattern::page : Pattern::magazine);
  if (is_open) print.main = Rgb::Constant(0.86F);
  print.gloss = static_cast<float>(random.uniform(0.1, 0.5));
  Thing thing = sheet("magazine", size, 0.0005, print);
  return std::move(thing.withTop(kSheetRim_m));
}

Thing makeThinBook(HashStream& random) {
  SyntheticScene scene;
  const Vec3 size{random.uniform(0.1, 0.18), random.uniform(0.15, 0.25), random.uniform(0.006, 0.014)};
  addBook(scene, "book", {}, size, randomPrint(random, Pattern::bookCover));
  return std::move(Thing(std::move(scene)).withTop(kSheetRim_m));
}

Thing makeRandomKnife(HashStream& random) {
  const Material steel = cutlery(random);
  const bool has_handle = random.chance(0.4);
  Smith knife("knife", steel);
  const double handle = random.uniform(0.085, 0.11);
  knife.bar(0, handle, random.uniform(0.014, 0.019), has_handle ? 0.011 : 0.005);
  knife.goOn(handle - 0.002);
  knife.bar(0, random.uniform(0.09, 0.13), random.uniform(0.016, 0.022), 0.002);
  Thing thing = knife.finish();
  if (has_handle) thing.parts.front().material = randomDarkness(random);
  return thing;
}

Thing makeRandomFork(HashStream& random) {
  const Material steel = cutlery(random);
  Smith fork("fork", steel);
  const double handle = random.uniform(0.11, 0.14);
  fork.bar(0, handle, random.uniform(0.009, 0.014), 0.004);
  fork.goOn(handle - 0.002);
  const double head = random.uniform(0.02, 0.024);
  fork.bar(0, 0.028, head, 0.004);
  fork.goOn(0.026);
  const int tines = random.between(3, 4);
  const double apart = (head - 0.0035) / (tines - 1);
  for (int i = 0; i < tines; ++i) fork.bar(i * apart - (head - 0.0035) / 2, 0.04, 0.0035, 0.003);
  return fork.finish();
}

Thing makeRandomSpoon(HashStream& random) {
  const Material steel = cutlery(random);
  Smith spoon("spoon", steel);
  const double handle = random.uniform(0.1, 0.15);
  spoon.bar(0, handle, random.uniform(0.008, 0.013), 0.004);
  spoon.goOn(handle - 0.003);
  spoon.bowl(random.uniform(0.015, 0.024));
  return spoon.finish();
}

Thing makeRandomPen(HashStream& random) {
  SyntheticScene scene;
  const auto id = scene.addInstance("pen", true);
  const double radius = random.uniform(0.0035, 0.0062);
  const double length = random.uniform(0.12, 0.16);
  const double cap = random.uniform(0.35, 0.6) * length;
  const Material body = random.chance(0.3) ? randomDarkness(random) : randomLacquer(random);
  Material end = body;
  if (random.chance(0.5)) end.main = randomColor(random);
  addPart(scene, id, {},
          std::make_unique<Lathe>(
              Lathe::Profile{{0, 0}, {0.001, 0}, {radius, 2 * radius}, {radius, length}, {0, length}}),
          body);
  addPart(scene, id, {}, std::make_unique<Lathe>(canProfile(radius + 0.0005, radius + 0.0005, cap, 0.001)),
          end, {0, 0, length - cap + 0.001});
  Thing pen(std::move(scene));
  return std::move(pen.layDown());
}

Thing makeRandomKeyboard(HashStream& random) {
  const bool is_dark = random.chance(0.6);
  Material skin = randomDarkness(random);
  skin.pattern = Pattern::keys;
  skin.gloss *= 0.4F;
  if (!is_dark) {
    skin.main = Rgb::Constant(static_cast<float>(random.uniform(0.5, 0.85)));
    skin.second = skin.main * 0.4F;
    skin.third = Rgb::Constant(0.05F);
    skin.darkness = 0;
  }
  const Vec3 size{random.uniform(0.28, 0.45), random.uniform(0.11, 0.15), random.uniform(0.009, 0.014)};
  return sheet("keyboard", size, 0.003, skin);
}

Thing makeFlatPlate(HashStream& random) {
  SyntheticScene scene;
  const double radius = random.uniform(0.075, 0.13);
  const Material glaze = random.chance(0.5) ? randomLacquer(random) : randomGlaze(random);
  addPart(
      scene, scene.addInstance("plate", true, true), {},
      std::make_unique<Lathe>(Lathe::Profile{
          {0, 0}, {radius * 0.62, 0}, {radius, 0.010}, {radius, 0.014}, {radius * 0.6, 0.004}, {0, 0.004}}),
      glaze);
  return Thing(std::move(scene), true);
}

Thing makeRandomPhone(HashStream& random) {
  const double length = random.chance(0.7) ? random.uniform(0.13, 0.165) : random.uniform(0.2, 0.26);
  Material screen = randomDarkness(random);
  screen.gloss = static_cast<float>(random.uniform(0.5, 0.8));
  return sheet("phone", {0.5 * length, length, random.uniform(0.006, 0.01)}, 0.003, screen);
}

Thing makeRandomNapkin(HashStream& random) {
  const double side = random.uniform(0.11, 0.2);
  const double width = side * random.pick({1.0, 0.5});
  return sheet("napkin", {width, side, random.uniform(0.0015, 0.006)}, 0.0007, randomCloth(random));
}

Thing makeRandomFlatThing(HashStream& random) {
  switch (random.below(18)) {
    case 0:
    case 1:
    case 2:
    case 3:
      return makeRandomPaper(random);
    case 4:
    case 5:
      return makeRandomMagazine(random);
    case 6:
    case 7:
      return makeThinBook(random);
    case 8:
      return makeRandomKnife(random);
    case 9:
      return makeRandomFork(random);
    case 10:
      return makeRandomSpoon(random);
    case 11:
    case 12:
      return makeRandomPen(random);
    case 13:
      return makeRandomKeyboard(random);
    case 14:
    case 15:
      return makeFlatPlate(random);
    case 16:
      return makeRandomPhone(random);
    default:
      return makeRandomNapkin(random);
  }
}

Thing makeFlatStackable(HashStream& random) {
  switch (random.below(3)) {
    case 0:
      return makeRandomPaper(random);
    case 1:
      return makeRandomMagazine(random);
    default:
      return makeThinBook(random);
  }
}

}  // namespace scantrove::synthetic
