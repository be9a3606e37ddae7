#pragma once
#include <Eigen/Core>
#include <span>

namespace scantrove {

/// Longest side, in metres, of the box around measured points along their principal axes. Ignores a hundredth
/// of the points at either end and stray points far from all others as noise. 0 for fewer than three points.
[[nodiscard]] double longestSide(std::span<const Eigen::Vector3f> points);

}  // namespace scantrove
