#include "core/labeling/chroma_histogram.h"

#include <cmath>

#include "core/base/soft_bin.h"

namespace scantrove {
namespace {

constexpr float kGray = 0.5F * (ChromaHistogram::kSide - 1);  // its place between bins

SoftBin between(float value) {
  return SoftBin::at(value / ChromaHistogram::kBinWidth + kGray, ChromaHistogram::kSide);
}

}  // namespace

void ChromaHistogram::add(const Eigen::Vector3f& lab) {
  const SoftBin a = between(lab[1]), b = between(lab[2]);
  float* lower = counts_.data() + a.bin * kSide + b.bin;
  float* upper = lower + kSide;
  lower[0] += a.lower * b.lower;
  lower[1] += a.lower * b.upper;
  upper[0] += a.upper * b.lower;
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
