#include "core/synthetic/placed_part.h"

#include <numbers>

#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {

Eigen::Isometry3d Place::pose() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Vec3(x, y, z);
  T.linear() = turned(yaw_deg, Vec3::UnitZ());
  return T;
}

Eigen::Matrix3d turned(double degrees, const Vec3& axis) {
  return Eigen::AngleAxisd(degrees / 180.0 * std::numbers::pi, axis).toRotationMatrix();
}

void addPart(SyntheticScene& scene, std::uint16_t instance, const Place& place, std::unique_ptr<Shape> shape,
             const Material& material, const Vec3& offset, const Eigen::Matrix3d& turn) {
  Eigen::Isometry3d T_object_part = Eigen::Isometry3d::Identity();
  T_object_part.linear() = turn;
  T_object_part.translation() = offset;
  scene.add(instance, std::move(shape), place.pose() * T_object_part, material);
}

void addBox(SyntheticScene& scene, std::uint16_t instance, const Place& place, const Vec3& size,
            double radius, const Material& material, const Vec3& offset) {
  addPart(scene, instance, place, std::make_unique<RoundedBox>(size / 2, radius), material,
          offset + Vec3(0, 0, size.z() / 2));
}

}  // namespace scantrove::synthetic
