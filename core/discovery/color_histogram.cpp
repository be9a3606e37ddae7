#include "core/discovery/color_histogram.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/base/soft_bin.h"

namespace scantrove {
namespace {

SoftBin between(float value, float lowest, float highest) {
  constexpr float kLast = ColorHistogram::kBins - 1;
  return SoftBin::at((value - lowest) / (highest - lowest) * kLast, ColorHistogram::kBins);
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
  const SoftBin l = between(lab[0], 0, 100), a = between(lab[1], -50, 50), b = between(lab[2], -50, 50);
  float* bins = &bins_[(l.bin * kBins + a.bin) * kBins + b.bin];
  const auto addRow = [&b](float* row, float weight) {
    row[0] += weight * b.lower;
    row[1] += weight * b.upper;
  };
  addRow(bins, l.lower * a.lower);
  addRow(bins + kBins, l.lower * a.upper);
  addRow(bins + kBins * kBins, l.upper * a.lower);
  addRow(bins + kBins * kBins + kBins, l.upper * a.upper);
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
