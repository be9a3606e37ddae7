#pragma once
#include <algorithm>
#include <cmath>

#include "core/synthetic/hash_random.h"
#include "core/synthetic/material.h"

namespace scantrove::synthetic::pattern {

// Building blocks of patterns: functions of surface coordinates that fade where a pixel cannot resolve them.

[[nodiscard]] inline std::uint32_t cell(float x) { return static_cast<std::uint32_t>(floorInt(x)); }

[[nodiscard]] inline float fraction(float x) { return x - static_cast<float>(floorInt(x)); }

[[nodiscard]] inline float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

[[nodiscard]] inline Rgb mix(const Rgb& a, const Rgb& b, float t) { return a + (b - a) * t; }

/// Smooth noise in -1..1 on a lattice of step 1.
[[nodiscard]] inline float noise(float x, float y, std::uint32_t seed) {
  const std::uint32_t ix = cell(x);
  const std::uint32_t iy = cell(y);
  const float tx = fraction(x);
  const float ty = fraction(y);
  const float fx = tx * tx * (3 - 2 * tx);
  const float fy = ty * ty * (3 - 2 * ty);
  const auto at = [&](std::uint32_t dx, std::uint32_t dy) {
    return hashUniform(hashBits(ix + dx, iy + dy, 7, seed));
  };
  const float top = at(0, 0) + (at(1, 0) - at(0, 0)) * fx;
  const float bottom = at(0, 1) + (at(1, 1) - at(0, 1)) * fx;
  return 2 * (top + (bottom - top) * fy) - 1;
}

/// 1 where a pixel resolves detail of size `detail_m`, 0 where it is larger.
[[nodiscard]] inline float detail(float detail_m, float footprint_m) {
  return 1 - smoothstep(0.4F, 1.2F, footprint_m / detail_m);
}

/// Noise with features of `size_m` that fades where a pixel is larger, at no cost there.
[[nodiscard]] inline float fineNoise(float x, float y, std::uint32_t seed, float size_m, float footprint_m) {
  const float visible = detail(size_m, footprint_m);
  return visible > 0 ? visible * noise(x, y, seed) : 0.0F;
}

/// 1 inside a band of relative `width` around the cell borders of x, anti-aliased over `blur` cells.
[[nodiscard]] inline float joint(float x, float width, float blur) {
  const float f = fraction(x);
  const float distance = std::min(f, 1 - f);
  return 1 - smoothstep(width, width + blur + 1e-4F, distance);
}

/// -1/+1 stripes of unit width with soft borders.
[[nodiscard]] inline float stripe(float x, float blur) {
  const float f = fraction(x * 0.5F) * 2;  // 0..2
  const float to_border = f < 1 ? std::min(f, 1 - f) : -std::min(f - 1, 2 - f);
  return std::clamp(to_border / (0.5F * blur + 1e-3F), -1.0F, 1.0F);
}

/// Rows of dark word-like bars inside 0..1 x 0..1, `rows` of them: 1 = ink.
[[nodiscard]] inline float print(float x, float y, float rows, std::uint32_t seed) {
  if (x < 0 || x > 1 || y < 0 || y > 1) {
    return 0;
  }
  const float row = y * rows;
  const float f = fraction(row);
  if (f < 0.25F || f > 0.75F) {
    return 0;
  }
  const float words = 9;
  const bool word = hashBits(cell(x * words), cell(row), 3, seed) % 5 != 0;
  const bool in_line = x < 0.55F + 0.45F * hashUniform(hashBits(cell(row), 5, 1, seed));
  return word && in_line ? 1.0F : 0.0F;
}

}  // namespace scantrove::synthetic::pattern
