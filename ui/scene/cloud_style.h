#pragma once
#include <Eigen/Core>
#include <array>
#include <set>

#include "core/exchange/region_palette.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// What the points of the cloud show by their colour.
enum class Coloring { scene, regions, blended, normals, height };
inline constexpr std::array kColorings{Coloring::scene, Coloring::regions, Coloring::blended,
                                       Coloring::normals, Coloring::height};

/// How regions look that are background.
enum class BackgroundStyle { as_others, dimmed, hidden };

/// What decides about a point's colour besides the point and its region.
struct CloudStyle {
  Coloring coloring = Coloring::regions;
  BackgroundStyle background_style = BackgroundStyle::as_others;
  std::set<RegionId> background;
  Rgb backdrop{32, 35, 42};  ///< what is dimmed nearly becomes this
  Eigen::Vector3f up = -Eigen::Vector3f::UnitY();
  float low_m = 0;   ///< along `up`: what is the lowest colour of Coloring::height
  float high_m = 2;  ///< and the highest

  [[nodiscard]] bool isBackground(RegionId region) const { return background.contains(region); }
  [[nodiscard]] bool hides(RegionId region) const {
    return background_style == BackgroundStyle::hidden && isBackground(region);
  }
};

/// The colour of a point of this region where `light` (0..1) falls on it.
[[nodiscard]] Rgb pointColor(const CloudStyle& style, const CloudBrick::Point& point, RegionId region,
                             float light);

/// The colour for a height, 0 (lowest) to 1.
[[nodiscard]] Rgb heightColor(float fraction);

}  // namespace scantrove
