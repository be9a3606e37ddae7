#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace scantrove {

/// Histogram of the object's colours in CIELAB: 5 bins of L (0 .. 100) and 11 of each of a and b (-66 .. 66;
/// colours outside count in the last bin). Lightness has few, wide bins, because light and shadow change it.
/// A bin holds the square root of its share, as round(255 * root): the Hellinger distance needs only roots.
struct ViewColors {
  static constexpr std::size_t kLightness = 5, kChroma = 11, kBins = kLightness * kChroma * kChroma;

  std::array<std::uint8_t, kBins> roots{};  ///< by L, then a, then b
};

/// `color` (CV_8UC3 BGR) and `mask` (CV_8UC1) share any size. Leaves out the outermost pixels of the mask
/// where enough remain, because they mix object and background. None: no colour or no object pixel.
[[nodiscard]] std::optional<ViewColors> describeColors(const cv::Mat& color, const cv::Mat& mask);

/// Squared Hellinger distance, 1 - sum of sqrt(p q): 0 = the same shares, 1 = no colour in common.
[[nodiscard]] float colorDistance(const ViewColors& a, const ViewColors& b);

}  // namespace scantrove
