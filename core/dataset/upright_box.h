#pragma once
#include <Eigen/Geometry>
#include <array>
#include <span>

namespace scantrove {

/// A box that stands upright and is turned about the vertical. In a frame with z up, metres.
struct UprightBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< along its axes x, y and z; x is the longer level side
  double yaw_rad = 0;                              ///< of its x axis, counter-clockwise from x; 0 <= yaw < pi

  /// The corners of its base from (+x, +y), counter-clockwise from above, at the height of the centre.
  [[nodiscard]] std::array<Eigen::Vector3d, 4> levelCorners() const;
};

/// The upright box of least base around `points` (z up). It leaves out the outermost half percent at both
/// ends of each axis, so that stray points do not stretch it, and uses at most 8192 points, evenly chosen.
/// The yaw is 0 (or a right angle) where another would make the base smaller by less than 2 %: round objects.
/// Sizes are zero without points.
[[nodiscard]] UprightBox fitUprightBox(std::span<const Eigen::Vector3f> points);

}  // namespace scantrove
