#include "core/segmentation/upsample_segments.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace scantrove {
namespace {

/// For each of `size` target pixels the source pixel whose cell holds its centre: floor((t + 0.5) * source /
/// size).
std::vector<std::size_t> nearest(int source, int size) {
  std::vector<std::size_t> result(static_cast<std::size_t>(size));
  for (std::size_t t = 0; t < result.size(); ++t) {
    result[t] = (2 * t + 1) * static_cast<std::size_t>(source) / (2 * static_cast<std::size_t>(size));
  }
  return result;
}

constexpr int kSearch_px = 3;  // the band that a raycast misses along depth edges is up to 3 pixels wide
constexpr float kSameDepth_m = 0.02F;  // beyond it (times z^2 from 1 m on) a surface is another one
constexpr float kDepthPerPixel_m =
    0.004F;  // so much difference in depth weighs as much as one pixel of distance

}  // namespace

std::vector<std::uint32_t> upsampleByDepth(std::span<const std::uint32_t> ids,
                                           std::span<const float> depths_m, int width, int height,
                                           const DepthGuide& guide) {
  SCANTROVE_CHECK(width >= 0 && height >= 0 && guide.width >= 0 && guide.height >= 0);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  SCANTROVE_CHECK(ids.size() == pixels && depths_m.size() == pixels);
  std::vector<std::uint32_t> result(
      static_cast<std::size_t>(guide.width) * static_cast<std::size_t>(guide.height), 0);
  SCANTROVE_CHECK(guide.depth.size() == result.size());
  if (pixels == 0) return result;

  const std::vector<std::size_t> source_x = nearest(width, guide.width);
  const std::vector<std::size_t> source_y = nearest(height, guide.height);
  const float per_x = static_cast<float>(width) / static_cast<float>(guide.width);
  const float per_y = static_cast<float>(height) / static_cast<float>(guide.height);
  std::size_t target = 0;
  for (int v = 0; v < guide.height; ++v) {
    const int y0 = static_cast<int>(source_y[static_cast<std::size_t>(v)]);
    const float y_exact = (static_cast<float>(v) + 0.5F) * per_y - 0.5F;
    for (int u = 0; u < guide.width; ++u, ++target) {
      const int x0 = static_cast<int>(source_x[static_cast<std::size_t>(u)]);
      const float z = static_cast<float>(guide.depth[target]) * guide.metres_per_unit;
      if (!(z > 0)) {
        result[target] = ids[static_cast<std::size_t>(y0) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x0)];
        continue;
      }
      const float x_exact = (static_cast<float>(u) + 0.5F) * per_x - 0.5F;
      const float grow = std::max(1.0F, z * z);
      float best = kSearch_px + kSameDepth_m / kDepthPerPixel_m + 2;
      for (int y = std::max(y0 - kSearch_px, 0); y <= std::min(y0 + kSearch_px, height - 1); ++y) {
        for (int x = std::max(x0 - kSearch_px, 0); x <= std::min(x0 + kSearch_px, width - 1); ++x) {
          const std::size_t source =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
          const float step_m = std::abs(depths_m[source] - z) / grow;
          if (ids[source] == 0 || !(step_m < kSameDepth_m)) continue;
          const float cost = std::hypot(static_cast<float>(x) - x_exact, static_cast<float>(y) - y_exact) +
                             step_m / kDepthPerPixel_m;
          if (cost < best) {
            best = cost;
            result[target] = ids[source];
          }
        }
      }
    }
  }
  return result;
}

}  // namespace scantrove
