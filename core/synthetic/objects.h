#pragma once
#include <string>

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

// Small things, 5 - 40 cm. Each adds one object instance of the given name and returns its id.
std::uint16_t addMug(SyntheticScene& scene, const std::string& name, const Place& place,
                     const Material& material);
std::uint16_t addTeapot(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material);
std::uint16_t addBowl(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addVase(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addCan(SyntheticScene& scene, const std::string& name, const Place& place,
                     const Material& material);
std::uint16_t addBottle(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material);
std::uint16_t addBall(SyntheticScene& scene, const std::string& name, const Place& place, double radius,
                      const Material& material);
std::uint16_t addRing(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addArch(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material);
std::uint16_t addCarton(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                        const Material& material);
/// `size`: spine to fore edge, height, thickness. Upright books stand on their lower edge, spine towards -y.
std::uint16_t addBook(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                      const Material& material, bool upright = false);
/// Two slabs at a right angle: the foot lies along x, the upright stands at its -x end.
std::uint16_t addLBlock(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                        double thickness, double radius, const Material& material);
std::uint16_t addCactus(SyntheticScene& scene, const std::string& name, const Place& place);
std::uint16_t addLamp(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& shade);

// Furniture.
/// A wall 2.5 m high that lets light through.
void addWall(SyntheticScene& scene, const std::string& name, const Place& place, double length,
             std::uint32_t color);
/// A table's foot is the floor; `size` is length (x), depth (y) and height.
std::uint16_t addTable(SyntheticScene& scene, const Place& place, const Vec3& size, const Material& material);
/// Seat front towards -y of the chair's own frame; seat at 0.45 m, back up to 0.88 m.
std::uint16_t addChair(SyntheticScene& scene, const std::string& name, const Place& place,
                       const Material& frame, const Material& cushion);
std::uint16_t addStool(SyntheticScene& scene, const std::string& name, const Place& place,
                       const Material& material);
/// Open shelves, open towards -y.
std::uint16_t addShelf(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                       const Material& material);
std::uint16_t addBasket(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material);

}  // namespace scantrove::synthetic
