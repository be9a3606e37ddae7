#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/texturing/chart_cutter.h"

namespace scantrove {

/// Texels around a chart that repeat its rim, for filters of the programs that show it.
inline constexpr int kChartPad_px = 4;

/// The places of charts in a texture.
struct AtlasPlan {
  struct Place {
    cv::Rect rect;     ///< texels of the chart with its pad
    cv::Point origin;  ///< pixel of the resized image at the first texel of `rect`; may lie outside of it
  };

  cv::Size size;              ///< texels
  double scale = 1;           ///< images are resized by it
  std::vector<Place> places;  ///< by chart
  /// Faces without a view lie in rows from here on: `cell_px` texels square for each, or, where these would
  /// take too much room, one texel for each of 32 x 32 x 32 colours (`cell_px` = 1).
  int first_cell_row = 0;
  int cell_px = 0;
};

/// At most `max_size_px` wide and high, images resized by at most `max_scale` and less only if the charts
/// would not fit. None: they fit at no tenth of it.
[[nodiscard]] std::optional<AtlasPlan> planAtlas(const TextureCharts& cut, std::span<const TextureView> views,
                                                 int max_size_px, double max_scale);

/// The texels that charts take at the size of their images.
[[nodiscard]] double texelsOf(const TextureCharts& cut);

}  // namespace scantrove
