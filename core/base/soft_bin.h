#pragma once
#include <algorithm>
#include <cstddef>

namespace scantrove {

/// Linear interpolation between histogram bins: each value counts in the two nearest.
struct SoftBin {
  std::size_t bin;     ///< the lower of the two
  float lower, upper;  ///< weights of that bin and of the next; their sum is 1

  /// `place`: in bins, 0 at the middle of the first; values outside are clamped to the first or last of
  /// `bins`.
  [[nodiscard]] static SoftBin at(float place, std::size_t bins) {
    constexpr float kBelowLast = 1e-3F;  // keeps the upper bin inside
    const float inside = std::clamp(place, 0.0F, static_cast<float>(bins - 1) - kBelowLast);
    const auto bin = static_cast<std::size_t>(inside);
    const float upper = inside - static_cast<float>(bin);
    return {bin, 1 - upper, upper};
  }
};

}  // namespace scantrove
