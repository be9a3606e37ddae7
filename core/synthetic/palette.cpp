#include "core/synthetic/palette.h"

#include <algorithm>
#include <cmath>

namespace scantrove::synthetic {
namespace {

/// Hue in turns, saturation and value 0..1, to linear light.
Rgb fromHsv(double hue, double saturation, double value) {
  std::uint32_t hex = 0;
  for (const double shift : {1.0, 2.0 / 3, 1.0 / 3}) {  // red, green, blue
    double unused = 0;
    const double ramp = std::clamp(std::abs(std::modf(hue + shift, &unused) * 6 - 3) - 1, 0.0, 1.0);
    hex = hex << 8 |
          static_cast<std::uint32_t>(std::lround(255 * value * (1 - saturation + saturation * ramp)));
  }
  return rgb(hex);
}

Rgb hsv(HashStream& random, double s_low, double s_high, double v_low, double v_high) {
  const double hue = random.uniform(0, 1);
  const double saturation = random.uniform(s_low, s_high);
  return fromHsv(hue, saturation, random.uniform(v_low, v_high));
}

}  // namespace

Rgb randomColor(HashStream& random) {
  return random.chance(0.25) ? hsv(random, 0.0, 0.2, 0.25, 0.95) : hsv(random, 0.3, 0.85, 0.4, 0.95);
}

Rgb randomPaint(HashStream& random) { return hsv(random, 0.02, 0.22, 0.72, 0.93); }

Material randomWood(HashStream& random) {
  const double hue = random.uniform(0.06, 0.11);
  const double saturation = random.uniform(0.3, 0.6);
  Material wood{Pattern::wood, fromHsv(hue, saturation, random.uniform(0.4, 0.9))};
  wood.second = randomPaint(random);
  wood.seed = random.bits();
  return wood;
}

Material randomPaintwork(HashStream& random) {
  if (random.chance(0.55)) return randomWood(random);
  Material paint{Pattern::plain, random.chance(0.7) ? randomPaint(random) : randomColor(random)};
  paint.second = paint.main * 0.7F;
  paint.seed = random.bits();
  return paint;
}

Material randomFabric(HashStream& random) {
  Material cloth{random.pick({Pattern::weave, Pattern::weave, Pattern::plain, Pattern::stripes})};
  cloth.main = randomColor(random);
  cloth.second = cloth.main * 0.75F;
  cloth.third = randomColor(random) * 0.4F + cloth.main * 0.6F;
  cloth.scale = static_cast<float>(random.uniform(0.015, 0.08));
  cloth.seed = random.bits();
  return cloth;
}

Material randomGlaze(HashStream& random) {
  Material glaze{random.pick(
      {Pattern::plain, Pattern::plain, Pattern::bands, Pattern::stripes, Pattern::dots, Pattern::speckle})};
  glaze.main = randomColor(random);
  glaze.second = randomColor(random);
  glaze.scale = static_cast<float>(random.uniform(0.012, 0.045));
  glaze.gloss = static_cast<float>(random.uniform(0, 0.5));
  glaze.seed = random.bits();
  return glaze;
}

Material randomPrint(HashStream& random, Pattern pattern) {
  Material print{pattern};
  print.main = randomColor(random);
  print.second = randomColor(random);
  print.third = hsv(random, 0.0, 0.3, 0.8, 1.0);
  print.gloss = static_cast<float>(random.uniform(0, 0.25));
  print.seed = random.bits();
  return print;
}

}  // namespace scantrove::synthetic
