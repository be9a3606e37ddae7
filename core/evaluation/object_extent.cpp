#include "core/evaluation/object_extent.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

namespace scantrove {

namespace {

float quantile(std::vector<float> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Removes points over four times the median distance from the centre: at outlines, depth cameras also
/// measure the background.
std::vector<Eigen::Vector3f> withoutStrays(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3f middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (const Eigen::Vector3f& point : points) values.push_back(point[axis]);
    middle[axis] = quantile(std::move(values), 0.5);
  }
  std::vector<float> distances;
  for (const Eigen::Vector3f& point : points) distances.push_back((point - middle).norm());
  const float farthest = 4 * quantile(std::move(distances), 0.5);
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3f& point : points) {
    if ((point - middle).norm() <= farthest) kept.push_back(point);
  }
  return kept;
}

}  // namespace

double longestSide(std::span<const Eigen::Vector3f> measured) {
  if (measured.size() < 3) return 0;
  const std::vector<Eigen::Vector3f> points = withoutStrays(measured);
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& point : points) mean += point / static_cast<float>(points.size());
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const Eigen::Vector3f& point : points) spread += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(spread);
  float longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> along;
    along.reserve(points.size());
    for (const Eigen::Vector3f& point : points)
      along.push_back((point - mean).dot(axes.eigenvectors().col(axis)));
    longest = std::max(longest, quantile(along, 0.99) - quantile(along, 0.01));
  }
  return longest;
}

}  // namespace scantrove
