#include "core/synthetic/material.h"

#include <algorithm>
#include <cmath>

#include "core/synthetic/pattern_tools.h"
#include "core/synthetic/printed_patterns.h"

namespace scantrove::synthetic {
namespace pattern {
namespace {

Rgb wood(const Material& m, float u, float v, float footprint) {
  const float wave = noise(u * 2.5F, v * 9, m.seed) * 0.6F;
  const float rings = fineNoise(u * 3 + 4 * wave, (v + 0.02F * wave) * 70, m.seed + 1, 0.012F, footprint);
  const float fibre = fineNoise(u * 25, v * 400, m.seed + 2, 0.0025F, footprint);
  return m.main * (1 + 0.16F * wave + 0.15F * rings + 0.07F * fibre);
}

Rgb planks(const Material& m, float u, float v, float footprint) {
  const float board = v / m.scale;
  const std::uint32_t row = cell(board);
  const float length = 1.1F;
  const float along = u / length + 0.37F * static_cast<float>(row % 5U);
  const std::uint32_t id = hashBits(row, cell(along), 11, m.seed);
  Material one = m;
  one.seed = id;
  one.main = m.main * (0.84F + 0.32F * hashUniform(id));
  Rgb color = wood(one, u, v, footprint);
  const float blur = footprint / m.scale;
  const float fade = detail(0.02F, footprint);
  const float gap = std::max(joint(board, 0.012F, blur), joint(along, 0.0012F, footprint / length));
  return color * (1 - 0.6F * gap * fade);
}

Rgb bookCover(const Material& m, const SurfacePoint& s, float footprint) {
  const float paper_lines = fineNoise(s.u * 3, s.v * 900, m.seed, 0.001F, footprint);
  if (s.face == 0) {  // the spine; u along y, v along z
    const float band = std::abs(s.ru);
    return band > 0.72F && band < 0.80F ? m.second
                                        : (band < 0.45F && std::abs(s.rv) < 0.35F ? m.third : m.main);
  }
  if (s.face < 4) {  // paper between two cover boards
    return std::abs(s.rv) > 0.86F ? m.main : rgb(0xf1ead8) * (0.93F + 0.07F * paper_lines);
  }
  const float edge = std::max(std::abs(s.ru), std::abs(s.rv));
  if (edge > 0.86F && edge < 0.90F) {
    return m.second;
  }
  const float disc = lengthOf(s.ru, s.rv + 0.25F);
  if (disc < 0.38F) {
    return fraction(disc * 8) < 0.5F ? m.third : m.second;
  }
  const float title = print(0.5F + 0.5F * s.ru / 0.7F, (0.75F - s.rv) / 0.4F, 2, m.seed);
  return mix(m.main, m.second, title);
}

Rgb boxLabel(const Material& m, const SurfacePoint& s) {
  const bool front = s.face == 2 || s.face == 3;
  if (s.rv < -0.62F) {  // the foot band
    return mix(m.second, m.third, print(0.5F + 0.5F * s.ru, (-0.62F - s.rv) / 0.38F, 2, m.seed + 9));
  }
  if (!front) {
    return mix(m.main, rgb(0x2b2b33), 0.8F * print(0.5F + 0.55F * s.ru, 0.5F - 0.6F * s.rv, 14, m.seed + 3));
  }
  const float disc = lengthOf(s.ru * 0.9F, s.rv + 0.08F);
  if (disc < 0.36F) {
    const float petals = std::cos(5 * std::atan2(s.rv + 0.08F, s.ru) + static_cast<float>(m.seed));
    return disc < 0.16F + 0.12F * petals ? m.second : m.third;
  }
  if (s.rv > 0.45F && s.rv < 0.85F) {
    return mix(m.main, m.third, print(0.5F + 0.6F * s.ru, (0.85F - s.rv) / 0.4F, 2, m.seed));
  }
  return m.main;
}

Rgb canLabel(const Material& m, const SurfacePoint& s) {
  const float height = std::abs(s.rv);
  if (height > 0.86F) {
    return rgb(0xb9bcc2);
  }
  if (height > 0.70F) {
    return m.second;
  }
  const float around = fraction(s.ru * 1.5F);  // the picture repeats three times in two turns
  const float disc = lengthOf((around - 0.5F) * 3, s.rv);
  if (disc < 0.55F) {
    return disc < 0.4F && fraction(disc * 9) < 0.5F ? m.second : m.third;
  }
  return m.main;
}

Rgb picture(const Material& m, const SurfacePoint& s) {
  if (s.face != 2 || std::max(std::abs(s.ru), std::abs(s.rv)) > 0.86F) {
    return m.main;
  }
  const float hills = 0.25F * noise(s.ru * 2, 0, m.seed) - 0.15F;
  const float near_hills = 0.2F * noise(s.ru * 3, 5, m.seed) - 0.45F;
  if (s.rv < near_hills) {
    return m.third;
  }
  if (s.rv < hills) {
    return m.second;
  }
  const float sun = lengthOf(s.ru - 0.35F, (s.rv - 0.4F) * 0.8F);
  return sun < 0.17F ? rgb(0xfff0b8) : mix(rgb(0xf3c9a0), rgb(0x8fc0dd), smoothstep(-0.2F, 0.8F, s.rv));
}

}  // namespace
}  // namespace pattern

Rgb rgb(std::uint32_t hex) {
  const auto linear = [](std::uint32_t byte) {
    const float s = static_cast<float>(byte & 0xffU) / 255.0F;
    return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
  };
  return {linear(hex >> 16), linear(hex >> 8), linear(hex)};
}

Rgb albedo(const Material& m, const SurfacePoint& s, float footprint) {
  using namespace pattern;
  const float blur = footprint / m.scale;
  switch (m.pattern) {
    case Pattern::plain:
      return m.main * (1 + 0.03F * fineNoise(s.u * 60, s.v * 60, m.seed, 0.01F, footprint));
    case Pattern::checker:
      return mix(m.main, m.second, 0.5F - 0.5F * stripe(s.u / m.scale, blur) * stripe(s.v / m.scale, blur));
    case Pattern::stripes:
      return mix(m.main, m.second, 0.5F - 0.5F * stripe(s.u / m.scale, blur));
    case Pattern::bands:
      return mix(m.main, m.second, 0.5F - 0.5F * stripe(s.v / m.scale, blur));
    case Pattern::dots: {
      const float row = s.v / m.scale;
      const float column = s.u / m.scale + 0.5F * static_cast<float>(cell(row) % 2U);
      const float distance = lengthOf(fraction(column) - 0.5F, fraction(row) - 0.5F);
      return mix(m.second, m.main, smoothstep(0.26F - 0.5F * blur, 0.26F + 0.5F * blur + 1e-3F, distance));
    }
    case Pattern::wood:
      return wood(m, s.u, s.v, footprint);
    case Pattern::planks:
      return planks(m, s.u, s.v, footprint);
    case Pattern::tiles: {
      const float gap = std::max(joint(s.u / m.scale, 0.02F, blur), joint(s.v / m.scale, 0.02F, blur));
      const float tone = hashUniform(hashBits(cell(s.u / m.scale), cell(s.v / m.scale), 2, m.seed));
      return mix(m.main * (0.9F + 0.2F * tone), m.second, gap * detail(0.03F, footprint));
    }
    case Pattern::weave: {
      const float edge = std::max(std::abs(s.ru), std::abs(s.rv));
      const float thread = fineNoise(s.u * 250, s.v * 250, m.seed, 0.006F, footprint);
      const float zigzag =
          stripe(s.v / m.scale + 0.8F * std::abs(fraction(s.u / m.scale * 0.5F) - 0.5F), blur);
      const Rgb field = edge > 0.78F && edge < 0.93F ? m.second : mix(m.main, m.third, 0.5F - 0.5F * zigzag);
      return (edge >= 0.93F ? m.third : field) * (1 + 0.14F * thread);
    }
    case Pattern::plaster:
      return m.main * (1 + 0.05F * noise(s.u * 1.7F, s.v * 1.7F, m.seed) +
                       0.05F * fineNoise(s.u * 40, s.v * 40, m.seed + 1, 0.025F, footprint));
    case Pattern::speckle: {
      const float specks = noise(s.u / m.scale, s.v / m.scale, m.seed);
      return mix(m.main, m.second, smoothstep(0.35F, 0.55F, specks) * detail(m.scale, footprint));
    }
    case Pattern::bookCover:
      return bookCover(m, s, footprint);
    case Pattern::boxLabel:
      return boxLabel(m, s);
    case Pattern::canLabel:
      return canLabel(m, s);
    case Pattern::picture:
      return picture(m, s);
    case Pattern::grain:
      return grain(m, s, footprint);
    case Pattern::floral:
      return floral(m, s, footprint);
    case Pattern::tartan:
      return tartan(m, s, footprint);
    case Pattern::page:
      return page(m, s, footprint);
    case Pattern::magazine:
      return magazine(m, s, footprint);
    case Pattern::packaging:
      return packaging(m, s, footprint);
    case Pattern::keys:
      return keys(m, s, footprint);
  }
  return m.main;
}

}  // namespace scantrove::synthetic
