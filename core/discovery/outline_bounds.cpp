#include "core/discovery/outline_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/discovery/color_contrast.h"

namespace scantrove {
namespace {

constexpr float kUsualContrast = 0.4F;  // without colour

class Bounds {
 public:
  void add(float how_clearly) {
    sum_ += how_clearly;
    ++steps_;
  }
  /// Mean with kUnknown neutral steps.
  [[nodiscard]] float mean() const {
    constexpr float kUnknown = 3;  // keeps a side with few steps half bounded
    return (sum_ + kUnknown / 2) / (static_cast<float>(steps_) + kUnknown);
  }

 private:
  float sum_ = 0;
  int steps_ = 0;
};

/// Of the four sides.
std::size_t sideOf(const Eigen::Vector2f& place) {
  if (std::abs(place.x()) > std::abs(place.y())) return place.x() > 0 ? 0 : 1;
  return place.y() > 0 ? 2 : 3;
}

}  // namespace

OutlineBounds outlineBoundsOf(const SetPixels& pixels, const SetAxes& axes, const DiscoveryInput& input) {
  const OutlineStepJudge judge(input);
  const int reach_px = colorReach(input.view.K.width);
  const auto contrastAt = [&](int u, int v, int du, int dv) {
    if (input.color_lab.empty()) return kUsualContrast;
    const std::size_t inside = pixels.contains(u - du, v - dv) ? pixels.at(u - du, v - dv) : pixels.at(u, v);
    return colorContrast(input.color_lab[inside],
                         input.color_lab[pixels.at(u + reach_px * du, v + reach_px * dv)]);
  };
  Bounds all;
  std::array<Bounds, 4> sides{};
  pixels.forEach([&](int u, int v) {
    for (const auto& [du, dv] : kFourNeighbors) {
      if (pixels.contains(u + du, v + dv) || !pixels.isInside(u + reach_px * du, v + reach_px * dv)) continue;
      const OutlineEnd end = judge.judge(u, v, du, dv);
      if (end == &OutlineSteps::hidden || end == &OutlineSteps::cut || end == &OutlineSteps::unseen) continue;
      const bool is_own = end == &OutlineSteps::open || end == &OutlineSteps::folded;
      const float how_clearly = is_own ? 1 : contrastAt(u, v, du, dv);
      all.add(how_clearly);
      sides[sideOf(axes(u, v))].add(how_clearly);
    }
  });
  OutlineBounds bounds{all.mean(), 1};
  for (const Bounds& side : sides) bounds.least_side = std::min(bounds.least_side, side.mean());
  return bounds;
}

}  // namespace scantrove
