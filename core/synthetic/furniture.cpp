#include "core/synthetic/furniture.h"

#include "core/synthetic/lathe.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {
/// A round leg between two points of the object's frame.
void addLeg(SyntheticScene& scene, std::uint16_t id, const Place& place, const Vec3& foot, const Vec3& head,
            double foot_radius, double head_radius, const Material& material) {
  const Vec3 along = head - foot;
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), along).toRotationMatrix();
  addPart(scene, id, place,
          std::make_unique<Lathe>(canProfile(foot_radius, head_radius, along.norm(), 0.003)), material, foot,
          turn);
}
}  // namespace

void addWall(SyntheticScene& scene, const std::string& name, const Place& place, double length,
             std::uint32_t color) {
  Material paint{Pattern::plaster, rgb(color)};
  paint.casts_shadow = false;
  paint.seed = static_cast<std::uint32_t>(scene.parts().size());
  addBox(scene, scene.addInstance(name, false), place, {length, 0.1, 2.5}, 0, paint);
}

std::uint16_t addTable(SyntheticScene& scene, const Place& place, const Vec3& size,
                       const Material& material) {
  const auto id = scene.addInstance("table", false);
  const double top = 0.03;
  addBox(scene, id, place, {size.x(), size.y(), top}, 0.006, material, {0, 0, size.z() - top});
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      addBox(scene, id, place, {0.055, 0.055, size.z() - top}, 0.006, material,
             {sx * (size.x() / 2 - 0.06), sy * (size.y() / 2 - 0.06), 0});
    }
  }
  return id;
}

std::uint16_t addChair(SyntheticScene& scene, const std::string& name, const Place& place,
                       const Material& frame, const Material& cushion) {
  const auto id = scene.addInstance(name, true, true);
  for (const double s : {-1.0, 1.0}) {
    addLeg(scene, id, place, {s * 0.205, -0.195, 0}, {s * 0.185, -0.175, 0.43}, 0.013, 0.019, frame);
    addLeg(scene, id, place, {s * 0.205, 0.225, 0}, {s * 0.190, 0.185, 0.44}, 0.013, 0.019, frame);
    addLeg(scene, id, place, {s * 0.190, 0.185, 0.42}, {s * 0.180, 0.255, 0.88}, 0.019, 0.014, frame);
  }
  addBox(scene, id, place, {0.43, 0.42, 0.03}, 0.012, frame, {0, 0, 0.425});
  addBox(scene, id, place, {0.39, 0.37, 0.035}, 0.015, cushion, {0, -0.015, 0.45});
  const Eigen::Matrix3d lean = turned(-8.5, Vec3::UnitX());
  addPart(scene, id, place, std::make_unique<RoundedBox>(Vec3(0.175, 0.012, 0.13), 0.010), cushion,
          {0, 0.240, 0.735}, lean);
  return id;
}

std::uint16_t addStool(SyntheticScene& scene, const std::string& name, const Place& place,
                       const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  addPart(scene, id, place, std::make_unique<Lathe>(canProfile(0.165, 0.165, 0.035, 0.010)), material,
          {0, 0, 0.415});
  Material legs = material;
  legs.main = material.second;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix3d turn = turned(120.0 * i + 20, Vec3::UnitZ());
    addLeg(scene, id, place, turn * Vec3(0.18, 0, 0), turn * Vec3(0.11, 0, 0.42), 0.013, 0.017, legs);
  }
  return id;
}

std::uint16_t addShelf(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                       const Material& material) {
  const auto id = scene.addInstance(name, false, true);
  const double board = 0.022;
  for (const double s : {-1.0, 1.0}) {
    addBox(scene, id, place, {board, size.y(), size.z()}, 0.002, material,
           {s * (size.x() - board) / 2, 0, 0});
  }
  for (const double level : {0.0, 0.5, 1.0}) {
    addBox(scene, id, place, {size.x(), size.y(), board}, 0.002, material,
           {0, 0, level * (size.z() - board)});
  }
  addBox(scene, id, place, {size.x(), 0.008, size.z()}, 0.001, material, {0, size.y() / 2 - 0.004, 0});
  return id;
}

std::uint16_t addBasket(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  addPart(scene, id, place,
          std::make_unique<Lathe>(
              Lathe::Profile{{0, 0}, {0.105, 0}, {0.145, 0.30}, {0.135, 0.30}, {0.098, 0.01}, {0, 0.01}}),
          material);
  return id;
}

}  // namespace scantrove::synthetic
