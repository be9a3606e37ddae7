#pragma once
#include <Eigen/Core>
#include <array>
#include <set>

#include "core/exchange/region_palette.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Colour modes of the cloud.
enum class Coloring { scene, regions, blended, normals, height };
inline constexpr std::array kColorings{Coloring::scene, Coloring::regions, Coloring::blended,
                                       Coloring::normals, Coloring::height};

/// Styles of background regions.
enum class BackgroundStyle { as_others, dimmed, hidden };

/// Settings for the colours of points.
struct CloudStyle {
  Coloring coloring = Coloring::regions;
  BackgroundStyle background_style = BackgroundStyle::as_others;
  std::set<RegionId> background;
  Rgb backdrop{32, 35, 42};  ///< colour that dimmed points are blended with
  Eigen::Vector3f up = -Eigen::Vector3f::UnitY();
  float low_m = 0;   ///< along `up`: lowest colour of Coloring::height
  float high_m = 2;  ///< along `up`: highest colour

  [[nodiscard]] bool isBackground(RegionId region) const { return background.contains(region); }
  [[nodiscard]] bool hides(RegionId region) const {
    return background_style == BackgroundStyle::hidden && isBackground(region);
  }
};

/// Colour of a point of this region under `light` (0..1).
[[nodiscard]] Rgb pointColor(const CloudStyle& style, const CloudBrick::Point& point, RegionId region,
                             float light);

/// Colour of a height from 0 (lowest) to 1.
[[nodiscard]] Rgb heightColor(float fraction);

}  // namespace scantrove
