#pragma once
#include <Eigen/Core>

namespace scantrove::synthetic {

/// The area a thing covers from above: a rectangle on the floor, grown by `round` on all sides. Metres.
struct Footprint {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d half = Eigen::Vector2d::Zero();  ///< along its own x and y
  double yaw_deg = 0;
  double round = 0;

  /// Transformed by the pose `(x, y, yaw)`.
  [[nodiscard]] Footprint placedAt(double x, double y, double yaw_deg) const;
};

/// Distance between two footprints; negative where they overlap.
[[nodiscard]] double distance(const Footprint& a, const Footprint& b);
/// Whether `inner` lies within `outer`, ignoring its rounding.
[[nodiscard]] bool contains(const Footprint& outer, const Footprint& inner);

/// An occupied vertical column of space.
struct Volume {
  Footprint base;
  double z_low = 0, z_high = 0;

  [[nodiscard]] Volume placedAt(double x, double y, double z, double yaw_deg) const {
    return {base.placedAt(x, y, yaw_deg), z_low + z, z_high + z};
  }
  [[nodiscard]] bool overlapsInHeight(const Volume& other) const {
    constexpr double kTouching_m = 1e-6;
    return z_low < other.z_high - kTouching_m && other.z_low < z_high - kTouching_m;
  }
};

/// Distance from a point to a volume; 0 inside.
[[nodiscard]] double distance(const Eigen::Vector3d& point, const Volume& volume);

}  // namespace scantrove::synthetic
