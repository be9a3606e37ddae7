#pragma once
#include <Eigen/Core>
#include <span>

namespace scantrove {

/// The longest side of the box around measured points, along their principal axes, metres. A hundredth of the
/// points at either end, and stray points far from all others, are taken for noise. 0 for fewer than three
/// points.
[[nodiscard]] double longestSide(std::span<const Eigen::Vector3f> points);

}  // namespace scantrove
