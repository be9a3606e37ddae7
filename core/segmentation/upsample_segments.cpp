#include "core/segmentation/upsample_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/ids.h"

namespace scantrove {
namespace {

/// For each of `size` target pixels the source pixel whose cell holds its centre: floor((t + 0.5) * source /
/// size).
std::vector<int> nearest(int source, int size) {
  std::vector<int> result(static_cast<std::size_t>(size));
  for (int t = 0; t < size; ++t) {
    result[static_cast<std::size_t>(t)] = static_cast<int>((2LL * t + 1) * source / (2LL * size));
  }
  return result;
}

constexpr int kSearch_px = 3;               // raycasts miss a band of up to 3 pixels along depth edges
constexpr float kSameDepth_m = 0.02F;       // beyond it (times z^2 from 1 m on) it is another surface
constexpr float kDepthPerPixel_m = 0.004F;  // depth difference that equals one pixel of distance
// A pixel's exact position is up to half a pixel from the nearest one in x and y: half of a diagonal, rounded
// up.
constexpr float kHalfDiagonal_px = 0.7072F;
constexpr float kRounding = 1.0001F;  // factor by which a distance certainly exceeds a bound

}  // namespace

std::vector<DepthUpsampler::Offset> DepthUpsampler::searchOrder() {
  std::vector<Offset> order;
  for (int y = -kSearch_px; y <= kSearch_px; ++y) {
    for (int x = -kSearch_px; x <= kSearch_px; ++x) {
      order.push_back({x, y, std::hypot(static_cast<float>(x), static_cast<float>(y)) - kHalfDiagonal_px});
    }
  }
  std::stable_sort(order.begin(), order.end(), [](const Offset& a, const Offset& b) {
    return a.least_distance_px < b.least_distance_px;
  });
  return order;
}

DepthUpsampler::DepthUpsampler(std::span<const float> depths_m, int width, int height,
                               const DepthGuide& guide)
    : depths_m_(depths_m), width_(width), height_(height), guide_(guide), order_(searchOrder()) {
  SCANTROVE_CHECK(width >= 0 && height >= 0 && guide.width >= 0 && guide.height >= 0);
  SCANTROVE_CHECK(depths_m.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  SCANTROVE_CHECK(guide.depth.size() ==
                  static_cast<std::size_t>(guide.width) * static_cast<std::size_t>(guide.height));
  nearest_x_ = nearest(width, guide.width);
  nearest_y_ = nearest(height, guide.height);
  closest_.assign(guide.depth.size(), kNone);
  if (depths_m.empty()) return;
  std::size_t target = 0;
  for (int v = 0; v < guide.height; ++v) {
    for (int u = 0; u < guide.width; ++u, ++target) {
      closest_[target] = guide.depth[target] == 0 ? nearest_y_[static_cast<std::size_t>(v)] * width +
                                                        nearest_x_[static_cast<std::size_t>(u)]
                                                  : closest(u, v, [](std::size_t) { return true; });
    }
  }
}

template <class Usable>
std::int32_t DepthUpsampler::closest(int u, int v, const Usable& is_usable) const {
  const int x0 = nearest_x_[static_cast<std::size_t>(u)], y0 = nearest_y_[static_cast<std::size_t>(v)];
  const float per_x = static_cast<float>(width_) / static_cast<float>(guide_.width);
  const float per_y = static_cast<float>(height_) / static_cast<float>(guide_.height);
  const float x_exact = (static_cast<float>(u) + 0.5F) * per_x - 0.5F;
  const float y_exact = (static_cast<float>(v) + 0.5F) * per_y - 0.5F;
  const std::size_t pixel =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(guide_.width) + static_cast<std::size_t>(u);
  const float z = static_cast<float>(guide_.depth[pixel]) * guide_.meters_per_unit;
  const float grow = std::max(1.0F, z * z);
  const bool is_inside =
      x0 >= kSearch_px && y0 >= kSearch_px && x0 < width_ - kSearch_px && y0 < height_ - kSearch_px;
  float best = std::numeric_limits<float>::max();
  std::int32_t best_source = kNone;
  for (const Offset& offset : order_) {
    if (offset.least_distance_px > best) break;
    const int x = x0 + offset.x, y = y0 + offset.y;
    if (!is_inside && (x < 0 || y < 0 || x >= width_ || y >= height_)) continue;
    const int source = y * width_ + x;
    const float step_m = std::abs(depths_m_[static_cast<std::size_t>(source)] - z);
    // Pixels that cannot be the closest need no exact distance.
    const float most_m = std::min(kSameDepth_m, (best - offset.least_distance_px) * kDepthPerPixel_m);
    if (step_m > kRounding * most_m * grow) continue;
    if (!(step_m / grow < kSameDepth_m) || !is_usable(static_cast<std::size_t>(source))) continue;
    const float cost = std::hypot(static_cast<float>(x) - x_exact, static_cast<float>(y) - y_exact) +
                       step_m / grow / kDepthPerPixel_m;
    // Among equal ones the first, row by row.
    if (cost < best || (cost == best && source < best_source)) {
      best = cost;
      best_source = source;
    }
  }
  return best_source;
}

template <class Id>
std::vector<Id> DepthUpsampler::apply(std::span<const Id> ids) const {
  SCANTROVE_CHECK(ids.size() == depths_m_.size());
  std::vector<Id> result(closest_.size(), Id{});
  for (std::size_t target = 0; target < result.size(); ++target) {
    std::int32_t source = closest_[target];
    if (source == kNone) continue;
    if (ids[static_cast<std::size_t>(source)] == Id{} && guide_.depth[target] != 0) {
      // A surface without id takes the closest id.
      const auto u = static_cast<int>(target % static_cast<std::size_t>(guide_.width));
      const auto v = static_cast<int>(target / static_cast<std::size_t>(guide_.width));
      source = closest(u, v, [&](std::size_t pixel) { return ids[pixel] != Id{}; });
      if (source == kNone) continue;
    }
    result[target] = ids[static_cast<std::size_t>(source)];
  }
  return result;
}

template std::vector<std::uint32_t> DepthUpsampler::apply(std::span<const std::uint32_t>) const;
template std::vector<RegionId> DepthUpsampler::apply(std::span<const RegionId>) const;

}  // namespace scantrove
