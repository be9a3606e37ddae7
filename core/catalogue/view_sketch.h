#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "core/catalogue/thumbnail.h"
#include "core/catalogue/view_colors.h"

namespace scantrove {

/// A view in few numbers, so that a search can compare a query with all views of a large catalogue: low
/// frequencies of the 16 x 16 thumbnail and of the histogram of colours. The cosine transform is the same
/// for all catalogues, so nothing is fitted and no view is described twice. A mirrored thumbnail only has
/// the other sign in its odd frequencies of x.
struct ViewSketch {
  static constexpr std::size_t kEven = 15, kOdd = 9;  ///< of the thumbnail, by the frequency of x
  static constexpr std::size_t kColors = 24;
  static constexpr std::size_t kNumbers = kEven + kOdd + kColors;
  static constexpr int kUnit = 32767;  ///< stored value of 1

  /// Coordinates of two vectors that have length 1 in full: the thumbnail, and the roots of the histogram.
  std::array<std::int16_t, kNumbers> numbers{};
  float length = 0;  ///< of the thumbnail, before it became 1
  /// Logarithms of the diagonal / 2 and of the sides / 6: sizeDifference() is the sum of their differences.
  std::array<float, 4> log_sizes{};
  bool has_colors = false, has_size = false;
};

/// `size_m`: sides of the oriented box, longest first; zero: unknown.
[[nodiscard]] ViewSketch sketchOf(const decltype(Thumbnail::coarse)& coarse,
                                  const std::optional<ViewColors>& colors, const Eigen::Vector3f& size_m);

}  // namespace scantrove
