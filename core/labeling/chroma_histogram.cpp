#include "core/labeling/chroma_histogram.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

constexpr float kGray = 0.5F * (ChromaHistogram::kSide - 1);  // its place between bins

/// Where a value lies between bins: the lower one, and the share of the next.
struct Between {
  int bin;
  float upper;
};

Between between(float value) {
  constexpr float kLast = ChromaHistogram::kSide - 1;
  const float place = std::clamp(value / ChromaHistogram::kBinWidth + kGray, 0.0F, kLast - 1e-3F);
  const int bin = static_cast<int>(place);
  return {bin, place - static_cast<float>(bin)};
}

}  // namespace

void ChromaHistogram::add(const Eigen::Vector3f& lab) {
  const Between a = between(lab[1]), b = between(lab[2]);
  float* lower = counts_.data() + a.bin * kSide + b.bin;
  float* upper = lower + kSide;
  lower[0] += (1 - a.upper) * (1 - b.upper);
  lower[1] += (1 - a.upper) * b.upper;
  upper[0] += a.upper * (1 - b.upper);
  upper[1] += a.upper * b.upper;
}

const ChromaHistogram::Bins& ChromaHistogram::chromas() {
  static const Bins of_bins = [] {
    Bins chromas;
    for (int a = 0; a < kSide; ++a) {
      for (int b = 0; b < kSide; ++b)
        chromas[a * kSide + b] =
            kBinWidth * std::hypot(static_cast<float>(a) - kGray, static_cast<float>(b) - kGray);
    }
    return chromas;
  }();
  return of_bins;
}

}  // namespace scantrove
