#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace scantrove {

/// Contrast of two colours (CIE L*a*b*): 0 = equal, 1 = at least the usual difference between two adjacent
/// objects.
[[nodiscard]] inline float colorContrast(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  constexpr float kClear = 30;  // L*a*b* differences from here on are obvious
  return std::min((a - b).norm(), kClear) / kClear;
}

/// Distance from an edge, in pixels, at which colours are compared, because edges are blurred.
[[nodiscard]] constexpr int colorReach(int width) {
  constexpr int kMin_px = 2, kPart = 160;  // the blur of labColors and of the lens, in 320 pixels
  return std::max(kMin_px, width / kPart);
}

}  // namespace scantrove
