#include "ui/scene/cloud_style.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

constexpr Rgb kUnseen{128, 130, 134};
constexpr float kMinSceneLight = 0.86F;  ///< scene colours include the light of the scene
constexpr float kRegionShare = 0.5F;     ///< share of the region colour in Coloring::blended
constexpr float kDimmedShare = 0.28F;    ///< share of the colour in a dimmed one

Eigen::Vector3f vectorOf(const Rgb& color) {
  return Eigen::Vector3i(color[0], color[1], color[2]).cast<float>();
}

Rgb rgbOf(const Eigen::Vector3f& color) {
  const auto channel = [&](int c) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(color[c], 0.0F, 255.0F)));
  };
  return {channel(0), channel(1), channel(2)};
}

Eigen::Vector3f sceneColor(const CloudBrick::Point& point, float light) {
  if (!point.color.known()) return light * vectorOf(kUnseen);
  return (kMinSceneLight + (1 - kMinSceneLight) * light) * vectorOf(point.color.rgb);
}

/// Red and green across `up`, blue along it.
Eigen::Vector3f normalColor(const Eigen::Vector3f& normal, const Eigen::Vector3f& up) {
  const Eigen::Vector3f across =
      std::abs(up.z()) < 0.9F ? Eigen::Vector3f(Eigen::Vector3f::UnitZ()) : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f side = up.cross(across).normalized();
  const Eigen::Vector3f turned(normal.dot(side), normal.dot(side.cross(up)), normal.dot(up));
  return (127.5F * (turned.array() + 1)).matrix();
}

Eigen::Vector3f litColor(const CloudStyle& style, const CloudBrick::Point& point, RegionId region,
                         float light) {
  switch (style.coloring) {
    case Coloring::scene:
      return sceneColor(point, light);
    case Coloring::regions:
      return light * vectorOf(regionColor(region));
    case Coloring::blended:
      return (1 - kRegionShare) * sceneColor(point, light) +
             kRegionShare * light * vectorOf(regionColor(region));
    case Coloring::normals:
      return normalColor(point.normal.unpacked(), style.up);
    case Coloring::height: {
      const float height = style.up.dot(point.center());
      return light *
             vectorOf(heightColor((height - style.low_m) / std::max(0.01F, style.high_m - style.low_m)));
    }
  }
  return Eigen::Vector3f::Zero();
}

}  // namespace

Rgb pointColor(const CloudStyle& style, const CloudBrick::Point& point, RegionId region, float light) {
  const Eigen::Vector3f color = litColor(style, point, region, light);
  if (style.background_style != BackgroundStyle::dimmed || !style.isBackground(region)) return rgbOf(color);
  // Less bright and less saturated, so that objects on the background stand out.
  const Eigen::Vector3f gray = Eigen::Vector3f::Constant(color.dot(Eigen::Vector3f(0.30F, 0.59F, 0.11F)));
  return rgbOf((1 - kDimmedShare) * vectorOf(style.backdrop) + kDimmedShare * (0.5F * color + 0.5F * gray));
}

Rgb heightColor(float fraction) {
  // Viridis: perceptually uniform, also for red-green colour blindness.
  constexpr std::array<Rgb, 6> kStops{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const float position = std::clamp(fraction, 0.0F, 1.0F) * static_cast<float>(kStops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const float beyond = position - static_cast<float>(below);
  return rgbOf((1 - beyond) * vectorOf(kStops[below]) + beyond * vectorOf(kStops[below + 1]));
}

}  // namespace scantrove
