#pragma once
#include <memory>

#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// Pose of an object: the middle of its foot, rotated by `yaw_deg` around the vertical.
struct Place {
  double x = 0, y = 0, z = 0;
  double yaw_deg = 0;
  [[nodiscard]] Eigen::Isometry3d pose() const;
};

/// Adds one part to an instance: `offset`, then `turn`, in the object's own frame.
void addPart(SyntheticScene& scene, std::uint16_t instance, const Place& place, std::unique_ptr<Shape> shape,
             const Material& material, const Vec3& offset = Vec3::Zero(),
             const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity());
/// A box of full `size` that stands on z = `offset.z()`.
void addBox(SyntheticScene& scene, std::uint16_t instance, const Place& place, const Vec3& size,
            double radius, const Material& material, const Vec3& offset = Vec3::Zero());
/// Rotation about an axis, degrees.
[[nodiscard]] Eigen::Matrix3d turned(double degrees, const Vec3& axis);

}  // namespace scantrove::synthetic
