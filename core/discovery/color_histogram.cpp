#include "core/discovery/color_histogram.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace scantrove {
namespace {

/// Where a value lies between bins: the lower one, and the share of the upper one.
struct Between {
  std::size_t bin;
  float upper;
};

Between between(float value, float lowest, float highest, std::size_t bins) {
  const float last = static_cast<float>(bins - 1);
  const float place = std::clamp((value - lowest) / (highest - lowest) * last, 0.0F, last - 1e-3F);
  const float floor = std::floor(place);
  return {static_cast<std::size_t>(floor), place - floor};
}

}  // namespace

ColorHistogram ColorHistogram::ofShares(const Shares& shares) {
  ColorHistogram histogram;
  histogram.bins_ = shares;
  histogram.colors_ = std::accumulate(shares.begin(), shares.end(), 0.0F);
  return histogram;
}

ColorHistogram::Shares ColorHistogram::shares() const {
  Shares shares = bins_;
  if (!isEmpty())
    for (float& share : shares) share /= colors_;
  return shares;
}

void ColorHistogram::add(const Eigen::Vector3f& lab) {
  const std::array<Between, 3> at{between(lab[0], 0, 100, kBins), between(lab[1], -50, 50, kBins),
                                  between(lab[2], -50, 50, kBins)};
  for (unsigned corner = 0; corner < 8; ++corner) {
    float weight = 1;
    std::size_t bin = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool is_upper = ((corner >> axis) & 1U) != 0;
      weight *= is_upper ? at[axis].upper : 1 - at[axis].upper;
      bin = bin * kBins + at[axis].bin + (is_upper ? 1 : 0);
    }
    bins_[bin] += weight;
  }
  ++colors_;
}

void ColorHistogram::add(const ColorHistogram& other) {
  std::ranges::transform(bins_, other.bins_, bins_.begin(), std::plus<>());
  colors_ += other.colors_;
}

float ColorHistogram::intersection(const ColorHistogram& other) const {
  const Shares a = shares(), b = other.shares();
  float common = 0;
  for (std::size_t bin = 0; bin < a.size(); ++bin) common += std::min(a[bin], b[bin]);
  return common;
}

}  // namespace scantrove
