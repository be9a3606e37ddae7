#include "core/catalogue/median_size.h"

#include <algorithm>
#include <cstddef>

namespace scantrove {
namespace {

/// Of an even number the mean of the middle two.
float medianOf(std::vector<float> values) {
  const std::size_t half = values.size() / 2;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(half));
  if (values.size() % 2 == 1) return values[half];
  const float below = *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half));
  return (below + values[half]) / 2;
}

}  // namespace

void MedianSize::add(const Eigen::Vector3f& size_m) {
  if (!size_m.allFinite() || size_m.isZero()) return;
  for (int i = 0; i < 3; ++i) sides_m_[static_cast<std::size_t>(i)].push_back(size_m[i]);
}

Eigen::Vector3f MedianSize::value_m() const {
  if (sides_m_[0].empty()) return Eigen::Vector3f::Zero();
  return {medianOf(sides_m_[0]), medianOf(sides_m_[1]), medianOf(sides_m_[2])};
}

}  // namespace scantrove
