#include "core/pipeline/object_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scantrove {
namespace {

constexpr std::size_t kOutliers = 20;    // so many points on each side may be noise
constexpr double kMostAtOnce_m = 0.015;  // a box grows with the frames, not at once
constexpr double kMostHalfSize_m = 0.6;  // from its middle

}  // namespace

void ObjectBox::growTo(std::span<const Eigen::Vector3d> points) {
  if (!grows || points.size() <= 2 * kOutliers) return;
  const Eigen::Vector3d middle = bounds.center();
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(points, values.begin(), [axis](const Eigen::Vector3d& p) { return p[axis]; });
    const auto low = values.begin() + static_cast<std::ptrdiff_t>(kOutliers);
    const auto high = values.end() - 1 - static_cast<std::ptrdiff_t>(kOutliers);
    std::nth_element(values.begin(), low, values.end());
    const double lowest = *low;
    std::nth_element(values.begin(), high, values.end());
    const double highest = *high;
    double& from = bounds.min()[axis];
    double& to = bounds.max()[axis];
    if (!(stands && axis == 2))
      from = std::min(from, std::max({lowest, from - kMostAtOnce_m, middle[axis] - kMostHalfSize_m}));
    to = std::max(to, std::min({highest, to + kMostAtOnce_m, middle[axis] + kMostHalfSize_m}));
  }
}

}  // namespace scantrove
