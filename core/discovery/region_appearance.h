#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/discovery/color_histogram.h"

namespace scantrove {

/// A point of a region's surface, with its colour where that is known.
struct AppearancePoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< metres
  std::array<std::uint8_t, 3> rgb{};                   ///< sRGB
  bool has_color = false;
};

/// How large a region is and what colours it has: enough to tell which others look like it.
struct RegionAppearance {
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< OrientedBox::size_m
  ColorHistogram colors;                             ///< empty: without colour
};

[[nodiscard]] RegionAppearance appearanceOf(std::span<const AppearancePoint> points);

/// 0 .. 1: how much the two look like one thing seen twice. 1 - half of the mean difference of the sides in
/// octaves, times the shared part of their colours; of size alone where neither has colour, and half of that
/// where one has none.
[[nodiscard]] float likeness(const RegionAppearance& a, const RegionAppearance& b);

}  // namespace scantrove
