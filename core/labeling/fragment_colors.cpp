#include "core/labeling/fragment_colors.h"

#include <algorithm>
#include <cmath>

namespace scantrove {

void ColorComparison::moveTowards(const ColorComparison& observed, float part) {
  for (const auto value :
       {&ColorComparison::difference, &ColorComparison::chroma_difference, &ColorComparison::shared,
        &ColorComparison::shared_chroma, &ColorComparison::elsewhere, &ColorComparison::variety}) {
    this->*value += part * (observed.*value - this->*value);
  }
}

FragmentColors::FragmentColors(const MergeInput& input, std::span<const FragmentId> parts) {
  if (input.color_lab.empty()) return;
  struct Sum {
    Eigen::Vector3f lab = Eigen::Vector3f::Zero();
    float squares = 0;
    float pixels = 0;
    ChromaHistogram chromas;
  };
  std::vector<Sum> sums;
  std::size_t place = 0;  // most pixels have the fragment of the previous one
  FragmentId last;
  for (std::size_t pixel = 0; pixel < parts.size(); ++pixel) {
    if (!parts[pixel] || !(input.view.vertices_world[pixel].w() > 0)) continue;
    if (parts[pixel] != last) {
      last = parts[pixel];
      place = places_.try_emplace(last, sums.size()).first->second;
      if (place == sums.size()) sums.emplace_back();
    }
    const Eigen::Vector3f& lab = input.color_lab[pixel];
    Sum& sum = sums[place];
    sum.lab += lab;
    sum.squares += lab.squaredNorm();
    sum.pixels += 1;
    sum.chromas.add(lab);
  }
  for (const Sum& sum : sums) {
    const Eigen::Vector3f mean = sum.lab / sum.pixels;
    const float variance = sum.squares / sum.pixels - mean.squaredNorm();
    colors_.push_back({sum.pixels, mean, std::sqrt(std::max(variance, 0.0F)), sum.chromas.counts()});
    all_ += sum.chromas.counts();
  }
}

const FragmentColors::Colors* FragmentColors::of(FragmentId fragment) const {
  const auto found = places_.find(fragment);
  return found == places_.end() ? nullptr : &colors_[found->second];
}

std::optional<ColorComparison> FragmentColors::between(FragmentId a, FragmentId b) const {
  const Colors *one = of(a), *other = of(b);
  if (one == nullptr || other == nullptr) return std::nullopt;
  const Eigen::Vector3f shift = other->mean_lab - one->mean_lab;
  const ChromaHistogram::Bins both = (one->chromas / one->pixels).min(other->chromas / other->pixels);
  const ChromaHistogram::Bins rest = (all_ - one->chromas - other->chromas).max(0.0F);
  const float shared = both.sum(), rest_pixels = rest.sum();
  return ColorComparison{shift.norm(),
                         shift.tail<2>().norm(),
                         shared,
                         (both * ChromaHistogram::chromas()).sum(),
                         shared > 0 && rest_pixels > 0 ? (both / shared).min(rest / rest_pixels).sum() : 0,
                         std::min(one->variety, other->variety)};
}

}  // namespace scantrove
