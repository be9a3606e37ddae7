#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/discovery/color_histogram.h"

namespace scantrove {

/// A point of a region's surface, with its colour and its normal if known.
struct AppearancePoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< metres
  std::array<std::uint8_t, 3> rgb{};                   ///< sRGB
  bool has_color = false;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, out of the surface; zero: unknown
};

/// Size and colours of a region, for finding similar ones.
struct RegionAppearance {
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< OrientedBox::size_m
  ColorHistogram colors;                             ///< empty: without colour
};

[[nodiscard]] RegionAppearance appearanceOf(std::span<const AppearancePoint> points);

/// Similarity of two regions, 0 .. 1: (1 - half of the mean difference of the sides in octaves) times the
/// intersection of their colours. By size alone if neither has colour, and half of that if one has none.
[[nodiscard]] float likeness(const RegionAppearance& a, const RegionAppearance& b);

}  // namespace scantrove
