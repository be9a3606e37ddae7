#include "core/labeling/fragment_colors.h"

namespace scantrove {

FragmentColors::FragmentColors(const MergeInput& input, std::span<const FragmentId> parts) {
  if (input.color_lab.empty()) return;
  struct Sum {
    Eigen::Vector3f lab = Eigen::Vector3f::Zero();
    int pixels = 0;
  };
  std::unordered_map<FragmentId, Sum> sums;
  Sum* of_last = nullptr;  // most pixels are of the same fragment as the one before
  FragmentId last;
  for (std::size_t pixel = 0; pixel < parts.size(); ++pixel) {
    if (!parts[pixel] || !(input.vertices_world[pixel].w() > 0)) continue;
    if (parts[pixel] != last) {
      last = parts[pixel];
      of_last = &sums[last];
    }
    of_last->lab += input.color_lab[pixel];
    ++of_last->pixels;
  }
  for (const auto& [fragment, sum] : sums)
    means_lab_.emplace(fragment, sum.lab / static_cast<float>(sum.pixels));
}

std::optional<ColorDifference> FragmentColors::between(FragmentId a, FragmentId b) const {
  const auto of_a = means_lab_.find(a), of_b = means_lab_.find(b);
  if (of_a == means_lab_.end() || of_b == means_lab_.end()) return std::nullopt;
  const Eigen::Vector3f shift = of_b->second - of_a->second;
  return ColorDifference{shift.norm(), shift.tail<2>().norm()};
}

}  // namespace scantrove
