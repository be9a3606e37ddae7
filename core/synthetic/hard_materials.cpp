#include "core/synthetic/hard_materials.h"

#include <algorithm>
#include <span>

#include "core/synthetic/palette.h"

namespace scantrove::synthetic {
namespace {

using Parts = std::vector<SyntheticScene::Part>;

float drawn(HashStream& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

void giveAll(Parts& parts, const Material& material) {
  for (SyntheticScene::Part& part : parts) {
    const bool casts_shadow = part.material.casts_shadow && material.casts_shadow;
    part.material = material;
    part.material.casts_shadow = casts_shadow;
  }
}

void polishAll(Parts& parts, float gloss, float polish) {
  for (SyntheticScene::Part& part : parts) {
    part.material.gloss = gloss;
    part.material.polish = polish;
  }
}

void giveTop(HashStream& random, Parts& parts) { parts.front().material = randomTop(random); }

void giveCloth(HashStream& random, Parts& parts) { giveAll(parts, randomCloth(random)); }

/// Cans: bare, or printed over metal.
void giveMetal(HashStream& random, Parts& parts) {
  if (random.chance(0.4)) return giveAll(parts, randomMetal(random));
  const float gloss = drawn(random, 0.5, 0.85);
  polishAll(parts, gloss, drawn(random, 80, 200));
}

/// Vessels: glass, glaze, black, or as they are.
void giveVessel(HashStream& random, Parts& parts) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.35) return giveAll(parts, randomGlass(random));
  if (kind < 0.55) return giveAll(parts, randomLacquer(random));
  if (kind < 0.65) return giveAll(parts, randomDarkness(random));
  if (kind < 0.75) return giveAll(parts, randomMetal(random));
}

void givePrint(HashStream& random, Parts& parts) {
  if (random.chance(0.25)) return;
  Material print = randomPrint(random, Pattern::packaging);
  print.gloss = drawn(random, 0, 0.4);
  giveAll(parts, print);
}

/// Covers, pictures behind glass, lacquered toys.
void giveCoat(HashStream& random, Parts& parts) {
  const float gloss = drawn(random, 0, 0.65);
  polishAll(parts, gloss, drawn(random, 60, 200));
}

/// Screens and their shells.
void giveBlack(HashStream& random, Parts& parts) { giveAll(parts, randomDarkness(random)); }

/// Bags and shoes; a third are black.
void giveLeather(HashStream& random, Parts& parts) {
  if (random.chance(0.35)) giveAll(parts, randomDarkness(random));
}

/// Furniture, varnished; some is black.
void giveVarnish(HashStream& random, Parts& parts) {
  if (random.chance(0.15)) return giveAll(parts, randomDarkness(random));
  polishAll(parts, drawn(random, 0, 0.45), 60);
}

struct Rule {
  const char* kind;
  void (*give)(HashStream&, Parts&);
};
constexpr Rule kRules[] = {
    {"table", giveTop},     {"desk", giveTop},         {"rug", giveCloth},        {"can", giveMetal},
    {"bottle", giveVessel}, {"vase", giveVessel},      {"jar", giveVessel},       {"bowl", giveVessel},
    {"mug", giveVessel},    {"teapot", giveVessel},    {"box", givePrint},        {"book", giveCoat},
    {"picture", giveCoat},  {"board", giveCoat},       {"ball", giveCoat},        {"ring", giveCoat},
    {"arch", giveCoat},     {"figure", giveCoat},      {"toy car", giveCoat},     {"monitor", giveBlack},
    {"laptop", giveBlack},  {"suitcase", giveLeather}, {"bag", giveLeather},      {"case", giveLeather},
    {"shoe", giveLeather},  {"chest", giveVarnish},    {"cupboard", giveVarnish}, {"shelf", giveVarnish},
    {"stool", giveVarnish},
};

}  // namespace

Material randomMetal(HashStream& random) {
  const float shade = drawn(random, 0.45, 0.85);
  const Rgb tint = random.pick(
      {Rgb(1.0F, 1.0F, 1.0F), Rgb(1.0F, 1.0F, 1.0F), Rgb(1.0F, 0.78F, 0.42F), Rgb(1.0F, 0.62F, 0.48F)});
  Material metal{Pattern::plain, tint * shade};
  metal.second = metal.main * 0.8F;
  metal.gloss = drawn(random, 0.82, 0.97);
  metal.polish = drawn(random, 100, 300);
  metal.seed = random.bits();
  return metal;
}

Material randomGlass(HashStream& random) {
  const bool is_tinted = random.chance(0.4);
  Material glass{Pattern::plain, is_tinted ? randomColor(random) : Rgb(Rgb::Constant(0.92F))};
  glass.gloss = drawn(random, 0.25, 0.5);
  glass.casts_shadow = false;
  glass.seed = random.bits();
  glass.polish = 300;
  glass.transparency = drawn(random, 0.7, 0.95);
  return glass;
}

Material randomLacquer(HashStream& random) {
  Material lacquer = randomGlaze(random);
  lacquer.gloss = drawn(random, 0.55, 0.88);
  lacquer.polish = drawn(random, 80, 300);
  return lacquer;
}

Material randomDarkness(HashStream& random) {
  Material black{Pattern::plain, Rgb::Constant(drawn(random, 0.008, 0.045))};
  black.second = black.main * 2;
  black.third = Rgb::Constant(0.6F);
  black.gloss = drawn(random, 0, 0.6);
  black.seed = random.bits();
  black.polish = drawn(random, 60, 200);
  black.darkness = drawn(random, 0.7, 0.97);
  return black;
}

Material randomCloth(HashStream& random) {
  Material cloth{random.pick({Pattern::floral, Pattern::floral, Pattern::tartan, Pattern::checker,
                              Pattern::stripes, Pattern::dots, Pattern::weave})};
  cloth.main = random.chance(0.5) ? randomPaint(random) : randomColor(random);
  cloth.second = randomColor(random);
  cloth.third = randomColor(random);
  cloth.scale = drawn(random, 0.02, 0.09);
  cloth.seed = random.bits();
  return cloth;
}

Material randomTop(HashStream& random) {
  Material top = randomWood(random);
  const double kind = random.uniform(0, 1);
  if (kind < 0.55) {
    top.pattern = Pattern::grain;
    top.scale = drawn(random, 0.008, 0.03);
  } else if (kind < 0.75) {  // stone
    top.pattern = Pattern::speckle;
    top.main = randomPaint(random) * drawn(random, 0.3, 1);
    top.second = top.main * random.pick({0.5F, 0.7F, 1.5F});
    top.scale = drawn(random, 0.006, 0.03);
  } else if (kind < 0.9) {
    top.pattern = Pattern::plain;
    top.main = random.chance(0.6) ? randomPaint(random) : randomColor(random);
  }
  top.gloss = drawn(random, 0, 0.6);
  top.polish = drawn(random, 60, 200);
  return top;
}

void giveHardMaterials(HashStream random, Thing& thing) {
  const auto rule = std::ranges::find_if(kRules, [&](const Rule& r) { return thing.who.name == r.kind; });
  if (rule != std::end(kRules)) rule->give(random, thing.parts);
}

}  // namespace scantrove::synthetic
