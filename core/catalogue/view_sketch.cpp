#include "core/catalogue/view_sketch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace scantrove {
namespace {

using Coarse = decltype(Thumbnail::coarse);

constexpr std::size_t kSide = Thumbnail::kCoarseSide, kPixels = Thumbnail::kCoarsePixels, kPlanes = 3;
constexpr std::size_t kEvenOfPlane = ViewSketch::kEven / kPlanes, kOddOfPlane = ViewSketch::kOdd / kPlanes;
constexpr std::size_t kOfPlane = kEvenOfPlane + kOddOfPlane;
static_assert(kEvenOfPlane * kPlanes == ViewSketch::kEven && kOddOfPlane * kPlanes == ViewSketch::kOdd);

/// Thinner sides count as so thick, as in sizeDifference().
constexpr float kThinnestSide_m = 0.03F;

/// A wave of the cosine transform, sampled at `count` places: cos(pi f (i + 1/2) / count), of length 1.
float wave(std::size_t frequency, std::size_t i, std::size_t count) {
  const double n = static_cast<double>(count);
  const double length = std::sqrt(frequency == 0 ? n : n / 2);
  const double angle = std::numbers::pi * static_cast<double>(frequency) * (static_cast<double>(i) + 0.5) / n;
  return static_cast<float>(std::cos(angle) / length);
}

/// For each pixel of a plane the values of all its waves, even ones first.
using PlaneWaves = std::array<std::array<float, kOfPlane>, kPixels>;

PlaneWaves planeWaves() {
  struct Frequency {
    std::size_t x, y;
  };
  // The lowest. Zero in both is left out: the mean over the object is zero.
  constexpr std::array<Frequency, kOfPlane> kFrequencies{
      {{0, 1}, {0, 2}, {2, 0}, {2, 1}, {0, 3}, {1, 0}, {1, 1}, {1, 2}}};
  PlaneWaves waves{};
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    for (std::size_t k = 0; k < kOfPlane; ++k) {
      waves[pixel][k] =
          wave(kFrequencies[k].x, pixel % kSide, kSide) * wave(kFrequencies[k].y, pixel / kSide, kSide);
    }
  }
  return waves;
}

/// For each bin of the histogram the values of all waves.
using ColorWaves = std::array<std::array<float, ViewSketch::kColors>, ViewColors::kBins>;

ColorWaves colorWaves() {
  constexpr std::size_t kChroma = ViewColors::kChroma, kLightness = ViewColors::kLightness;
  struct Frequency {
    std::size_t l, a, b, rank;
  };
  std::vector<Frequency> all;
  for (std::size_t l = 0; l < kLightness; ++l) {
    for (std::size_t a = 0; a < kChroma; ++a) {
      for (std::size_t b = 0; b < kChroma; ++b) all.push_back({l, a, b, 4 * l * l + a * a + b * b});
    }
  }
  // The lowest; bins of lightness are about twice as wide.
  std::ranges::stable_sort(all, {}, &Frequency::rank);
  ColorWaves waves{};
  for (std::size_t bin = 0; bin < ViewColors::kBins; ++bin) {
    const std::size_t l = bin / (kChroma * kChroma), a = bin / kChroma % kChroma, b = bin % kChroma;
    for (std::size_t k = 0; k < ViewSketch::kColors; ++k) {
      waves[bin][k] = wave(all[k].l, l, kLightness) * wave(all[k].a, a, kChroma) * wave(all[k].b, b, kChroma);
    }
  }
  return waves;
}

/// The waves' part of a vector of `length`, as coordinates of one of length 1.
std::int16_t coordinate(float value, float length) {
  return static_cast<std::int16_t>(
      std::lround(std::clamp(value / length, -1.0F, 1.0F) * static_cast<float>(ViewSketch::kUnit)));
}

void sketchThumbnail(const Coarse& coarse, ViewSketch& sketch) {
  static const PlaneWaves waves = planeWaves();
  int energy = 0;
  std::array<std::array<float, kOfPlane>, kPlanes> sums{};
  for (std::size_t plane = 0; plane < kPlanes; ++plane) {
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
      const int value = coarse[plane * kPixels + pixel];
      energy += value * value;
      for (std::size_t k = 0; k < kOfPlane; ++k)
        sums[plane][k] += static_cast<float>(value) * waves[pixel][k];
    }
  }
  sketch.length = std::sqrt(static_cast<float>(energy));
  if (energy == 0) return;
  for (std::size_t plane = 0; plane < kPlanes; ++plane) {
    for (std::size_t k = 0; k < kOfPlane; ++k) {
      const std::size_t place = k < kEvenOfPlane ? plane * kEvenOfPlane + k
                                                 : ViewSketch::kEven + plane * kOddOfPlane + k - kEvenOfPlane;
      sketch.numbers[place] = coordinate(sums[plane][k], sketch.length);
    }
  }
}

void sketchColors(const ViewColors& colors, ViewSketch& sketch) {
  static const ColorWaves waves = colorWaves();
  int energy = 0;
  std::array<float, ViewSketch::kColors> sums{};
  for (std::size_t bin = 0; bin < ViewColors::kBins; ++bin) {
    const int root = colors.roots[bin];
    if (root == 0) continue;  // most bins
    energy += root * root;
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += static_cast<float>(root) * waves[bin][k];
  }
  if (energy == 0) return;
  const float length = std::sqrt(static_cast<float>(energy));
  for (std::size_t k = 0; k < sums.size(); ++k)
    sketch.numbers[ViewSketch::kEven + ViewSketch::kOdd + k] = coordinate(sums[k], length);
}

}  // namespace

ViewSketch sketchOf(const Coarse& coarse, const std::optional<ViewColors>& colors,
                    const Eigen::Vector3f& size_m) {
  ViewSketch sketch;
  sketchThumbnail(coarse, sketch);
  if (colors) sketchColors(*colors, sketch);
  sketch.has_colors = colors.has_value();
  sketch.has_size = size_m.norm() > 0;
  if (!sketch.has_size) return sketch;
  sketch.log_sizes[0] = std::log(size_m.norm()) / 2;
  for (int i = 0; i < 3; ++i)
    sketch.log_sizes[static_cast<std::size_t>(i) + 1] = std::log(std::max(size_m[i], kThinnestSide_m)) / 6;
  return sketch;
}

}  // namespace scantrove
