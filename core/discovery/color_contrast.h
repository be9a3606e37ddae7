#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace scantrove {

/// How clearly two colours (CIE L*a*b*) differ: 0 = not at all, 1 = as much as two things side by side
/// mostly do, or more.
[[nodiscard]] inline float colorContrast(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  constexpr float kClear = 30;  // differences of L*a*b* from there on are plain to anybody
  return std::min((a - b).norm(), kClear) / kClear;
}

/// Colours are compared so many pixels off an edge, which is blurred: in an image of that width.
[[nodiscard]] constexpr int colorReach(int width) {
  constexpr int kMin_px = 2, kPart = 160;  // the blur of labColors and of the lens, in 320 pixels
  return std::max(kMin_px, width / kPart);
}

}  // namespace scantrove
