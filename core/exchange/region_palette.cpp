#include "core/exchange/region_palette.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scantrove {
namespace {

constexpr Rgb kUnlabeled{110, 114, 122};
constexpr std::uint32_t kTableSize = 4096;
constexpr double kGoldenAngle_rad = 2.39996322972865332;

std::uint8_t encodeSrgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

/// OKLCH to linear sRGB (Ottosson 2020, "A perceptual color space for image processing").
std::array<double, 3> linearFromOklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool displayable(const std::array<double, 3>& linear) {
  return std::all_of(linear.begin(), linear.end(), [](double c) { return c >= -1e-4 && c <= 1.0001; });
}

/// The most vivid displayable colour of that lightness and hue, up to `chroma`.
Rgb vivid(double lightness, double chroma, double hue) {
  std::array<double, 3> linear = linearFromOklch(lightness, chroma, hue);
  while (!displayable(linear) && chroma > 0.02) {
    chroma -= 0.005;
    linear = linearFromOklch(lightness, chroma, hue);
  }
  return {encodeSrgb(linear[0]), encodeSrgb(linear[1]), encodeSrgb(linear[2])};
}

Rgb makeColor(std::uint32_t id) {
  constexpr std::array<double, 3> kLightness{0.74, 0.64, 0.83};
  constexpr std::array<double, 2> kChroma{0.16, 0.11};
  return vivid(kLightness[id % 3], kChroma[(id / 3) % 2], kGoldenAngle_rad * id + 0.5);
}

Rgb colorOf(std::uint32_t id) {
  if (id == 0) return kUnlabeled;
  static const std::vector<Rgb> table = [] {
    std::vector<Rgb> colors(kTableSize);
    for (std::uint32_t i = 0; i < kTableSize; ++i) colors[i] = makeColor(i);
    return colors;
  }();
  return table[id % kTableSize == 0 ? 1 : id % kTableSize];
}

}  // namespace

Rgb regionColor(RegionId region) { return colorOf(region.value); }
Rgb segmentColor(SegmentId segment) { return colorOf(segment.value); }

}  // namespace scantrove
