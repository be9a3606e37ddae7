#include "core/synthetic/printed_patterns.h"

#include <numbers>

#include "core/synthetic/pattern_tools.h"

namespace scantrove::synthetic::pattern {
namespace {

constexpr float kInk = 0.85F;       // darkness of print on paper
constexpr float kMeanInk = 0.3F;    // of print that a pixel cannot resolve
constexpr float kLine_m = 0.0025F;  // height of printed letters

/// A place on a face: 0..1 from left to right and from top to bottom.
struct OnFace {
  float x, y;
};
OnFace onFace(const SurfacePoint& s) { return {0.5F + 0.5F * s.ru, 0.5F - 0.5F * s.rv}; }

/// A rectangle on a face, and the place in it, 0..1 inside.
struct Frame {
  float x, y, width, height;
  [[nodiscard]] bool contains(const OnFace& at) const {
    return at.x >= x && at.x <= x + width && at.y >= y && at.y <= y + height;
  }
  [[nodiscard]] OnFace within(const OnFace& at) const { return {(at.x - x) / width, (at.y - y) / height}; }
};

/// Lines of print in the frame, 0..1; grey where a pixel is larger than the letters.
float lines(const Frame& frame, const OnFace& at, float rows, std::uint32_t seed, float footprint) {
  if (!frame.contains(at)) return 0;
  const OnFace in = frame.within(at);
  const float visible = detail(kLine_m, footprint);
  return visible * print(in.x, in.y, rows, seed) + (1 - visible) * kMeanInk;
}

/// Large letters, resolved at any distance.
float title(const Frame& frame, const OnFace& at, float rows, std::uint32_t seed) {
  const OnFace in = frame.within(at);
  return print(in.x, in.y, rows, seed);
}

Rgb inked(const Rgb& paper, float ink) {
  static const Rgb kBlack = rgb(0x1d1d22);
  return mix(paper, kBlack, kInk * ink);
}

/// A printed picture: sky, hills, and a disc before them.
Rgb photo(const Material& m, const OnFace& in, std::uint32_t seed) {
  const float ground = 0.55F + 0.25F * noise(in.x * 2.5F, 0.5F, seed);
  const float disc = lengthOf(in.x - 0.2F - 0.6F * hashUniform(hashBits(seed)), in.y - 0.45F + 0.1F * ground);
  if (disc < 0.15F) return m.third;
  if (in.y > ground) return m.third * (0.55F + 0.25F * noise(in.x * 9, in.y * 9, seed + 1));
  return mix(m.second, Rgb::Constant(0.85F), 0.8F * in.y);
}

/// Dark bars on white.
Rgb barCode(const Frame& frame, const OnFace& at, std::uint32_t seed) {
  constexpr float kBars = 40;
  const bool is_bar = hashBits(cell(frame.within(at).x * kBars), 1, 9, seed) % 2 == 0;
  return is_bar ? Rgb::Constant(0.02F) : Rgb::Constant(0.9F);
}

}  // namespace

Rgb grain(const Material& m, const SurfacePoint& s, float footprint) {
  const float wave = noise(s.u * 1.6F, s.v * 6, m.seed);
  const float ring = s.v / m.scale + 2.5F * wave + 0.6F * noise(s.u * 5, s.v * 25, m.seed + 1);
  const float late = smoothstep(0.35F, 0.95F, 2 * std::abs(fraction(ring) - 0.5F));
  const float fibre = fineNoise(s.u * 25, s.v * 400, m.seed + 2, 0.0025F, footprint);
  const float dark = 0.55F * late * detail(m.scale, footprint);
  return m.main * ((1 + 0.15F * wave + 0.08F * fibre) * (1 - dark));
}

Rgb floral(const Material& m, const SurfacePoint& s, float footprint) {
  const float row = s.v / m.scale;
  const float column = s.u / m.scale + 0.5F * static_cast<float>(cell(row) % 2U);
  const float x = fraction(column) - 0.5F;
  const float y = fraction(row) - 0.5F;
  const std::uint32_t flower = hashBits(cell(column), cell(row), 5, m.seed);
  const float distance = lengthOf(x, y);
  const float angle = std::atan2(y, x) + 2 * std::numbers::pi_v<float> * hashUniform(flower);
  const float petals = 0.25F + 0.13F * std::cos(5 * angle);
  const float visible = detail(0.4F * m.scale, footprint);
  if (distance < 0.1F) return mix(m.main, m.third, visible);
  if (distance < petals) return mix(m.main, flower % 3U == 0 ? Rgb(m.third * 0.8F) : m.second, visible);
  return m.main;
}

Rgb tartan(const Material& m, const SurfacePoint& s, float footprint) {
  const float blur = footprint / m.scale;
  const auto band = [&](float x) { return 0.5F - 0.5F * stripe(2 * x / m.scale, 2 * blur); };
  const auto thread = [&](float x) { return joint(x / m.scale + 0.25F, 0.04F, blur); };
  const Rgb crossed = mix(m.main, m.second, 0.5F * (band(s.u) + band(s.v)));
  return mix(crossed, m.third, 0.8F * std::max(thread(s.u), thread(s.v)));
}

Rgb page(const Material& m, const SurfacePoint& s, float footprint) {
  if (s.face < 4) return m.main * 0.95F;
  const OnFace at = onFace(s);
  const std::uint32_t style = hashBits(m.seed, 3);
  const bool has_picture = style % 4U != 0;
  const Frame picture_frame{0.1F, 0.15F, style % 3U == 0 ? 0.45F : 0.8F, 0.33F};
  if (has_picture && picture_frame.contains(at)) return photo(m, picture_frame.within(at), m.seed + 4);
  float ink = title({0.1F, 0.06F, 0.8F, 0.06F}, at, 1, m.seed);
  const float top = has_picture ? 0.52F : 0.16F;
  const float height = 0.93F - top;
  const float rows = 34 * height;
  if (style / 16U % 2U == 0) {
    ink = std::max(ink, lines({0.1F, top, 0.8F, height}, at, rows, m.seed + 5, footprint));
  } else {
    for (const float left : {0.1F, 0.53F})
      ink = std::max(
          ink, lines({left, top, 0.37F, height}, at, rows, m.seed + (left > 0.5F ? 6U : 5U), footprint));
  }
  return inked(m.main, ink);
}

Rgb magazine(const Material& m, const SurfacePoint& s, float footprint) {
  static const Rgb kPaper = rgb(0xe9e5da);
  if (s.face < 4) return kPaper * (0.9F + 0.1F * fineNoise(s.u * 3, s.v * 900, m.seed, 0.001F, footprint));
  const OnFace at = onFace(s);
  constexpr Frame kCode{0.7F, 0.84F, 0.22F, 0.1F};
  if (kCode.contains(at)) return barCode(kCode, at, m.seed);
  const Rgb cover = photo(m, at, m.seed + 2);
  if (title({0.06F, 0.04F, 0.88F, 0.14F}, at, 1, m.seed) > 0) return m.main;
  return mix(cover, Rgb::Constant(0.95F), lines({0.06F, 0.35F, 0.4F, 0.5F}, at, 7, m.seed + 3, footprint));
}

Rgb packaging(const Material& m, const SurfacePoint& s, float footprint) {
  const OnFace at = onFace(s);
  const auto face = static_cast<std::uint32_t>(s.face);
  if (at.y > 0.85F) {
    return mix(m.second, m.third, title({0.05F, 0.86F, 0.9F, 0.12F}, at, 1, m.seed + face));
  }
  if (face == 2 || face == 3 || face == 5) {
    constexpr Frame kBrand{0.08F, 0.07F, 0.84F, 0.24F};
    constexpr Frame kPicture{0.14F, 0.38F, 0.72F, 0.4F};
    if (kBrand.contains(at)) return mix(m.second, m.third, title(kBrand, at, 1, m.seed));
    if (kPicture.contains(at)) return photo(m, kPicture.within(at), m.seed + 7);
    return m.main;
  }
  constexpr Frame kCode{0.6F, 0.62F, 0.32F, 0.18F};
  if (kCode.contains(at)) return barCode(kCode, at, m.seed);
  const float small_print = lines({0.08F, 0.1F, 0.84F, 0.45F}, at, 12, m.seed + face, footprint);
  return mix(m.main, m.third, small_print);
}

Rgb keys(const Material& m, const SurfacePoint& s, float footprint) {
  if (s.face != 5) return m.main * 0.8F;
  constexpr float kKey_m = 0.02F;
  const OnFace at = onFace(s);
  const float row = at.y * 5.4F - 0.2F;
  const float column = at.x * 15.4F - 0.2F + 0.25F * static_cast<float>(cell(row) % 3U);
  const float blur = footprint / kKey_m;
  const bool is_space_bar = cell(row) == 4 && at.x > 0.3F && at.x < 0.65F;
  const float gap = std::max(is_space_bar ? 0.0F : joint(column, 0.08F, blur), joint(row, 0.08F, blur));
  const bool is_letter = lengthOf(fraction(column) - 0.4F, fraction(row) - 0.4F) < 0.14F;
  const float letter = is_letter && !is_space_bar ? detail(0.006F, footprint) : 0.0F;
  return mix(mix(m.main, m.third, letter), m.second, gap * detail(kKey_m, footprint));
}

}  // namespace scantrove::synthetic::pattern
