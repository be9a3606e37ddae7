#pragma once
#include <Eigen/Core>
#include <span>

namespace scantrove {

/// The shape of a set of points by its principal axes.
struct OrientedBox {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();    ///< sides along the principal axes, longest first
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< columns: the principal axes, longest first
  float thickness_ratio = 0;  ///< sqrt(smallest / largest eigenvalue of the covariance)
};

/// The box along the principal axes (PCL's mean and covariance). It omits the outermost 1 % of the points at
/// both ends of each axis, so that stray points do not stretch it. Uses at most 4096 points, evenly chosen.
/// All zero for fewer than 3 points.
[[nodiscard]] OrientedBox fitOrientedBox(std::span<const Eigen::Vector4f> points);

}  // namespace scantrove
