#include "core/synthetic/bowls_and_boxes.h"

#include <cmath>

#include "core/synthetic/lathe.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

std::unique_ptr<Shape> lathe(const Lathe::Profile& profile) { return std::make_unique<Lathe>(profile); }

}  // namespace

std::uint16_t addMug(SyntheticScene& scene, const std::string& name, const Place& place,
                     const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  Lathe::Profile outer;
  appendArc(outer, {0.034, 0.006}, 0.006, -90, 0, 4);
  outer.emplace_back(0.042, 0.050);
  outer.emplace_back(0.042, 0.093);
  addPart(scene, id, place, lathe(vesselProfile(outer, 0.005)), material);
  Material handle = material;
  handle.pattern = Pattern::plain;
  handle.main = material.second;
  // The ring's axis is normal to the handle's plane; parts deeper than the wall are cut off.
  Eigen::Matrix3d turn;
  turn.col(0) = Vec3::UnitZ();
  turn.col(1) = Vec3::UnitX();
  turn.col(2) = Vec3::UnitY();
  addPart(scene, id, place, std::make_unique<Torus>(0.027, 0.006, -0.005), handle, Vec3(0.0445, 0, 0.050),
          turn);
  return id;
}

std::uint16_t addTeapot(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  Lathe::Profile body{{0, 0}};
  const auto side =
      smoothProfile({{0.05, 0.0}, {0.082, 0.045}, {0.076, 0.09}, {0.045, 0.118}, {0.012, 0.128}}, 6);
  body.insert(body.end(), side.begin(), side.end());
  appendArc(body, {0.0, 0.142}, 0.014, -50, 90, 6);
  addPart(scene, id, place, lathe(body), material);
  Material plain = material;
  plain.pattern = Pattern::plain;
  addPart(scene, id, place, lathe(canProfile(0.022, 0.010, 0.115, 0.003)), plain, Vec3(0.052, 0, 0.045),
          turned(48, Vec3::UnitY()));
  Eigen::Matrix3d turn;
  turn.col(0) = Vec3::UnitZ();
  turn.col(1) = -Vec3::UnitX();
  turn.col(2) = -Vec3::UnitY();
  addPart(scene, id, place, std::make_unique<Torus>(0.036, 0.0075, -0.016), plain, Vec3(-0.080, 0, 0.070),
          turn);
  return id;
}

std::uint16_t addBowl(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  Lathe::Profile outer{{0.040, 0.0}, {0.042, 0.006}};
  const auto side = smoothProfile({{0.043, 0.010}, {0.078, 0.030}, {0.100, 0.060}, {0.108, 0.085}}, 6);
  outer.insert(outer.end(), side.begin(), side.end());
  addPart(scene, id, place, lathe(vesselProfile(outer, 0.006)), material);
  return id;
}

std::uint16_t addVase(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  const auto side = smoothProfile({{0.040, 0.0},
                                   {0.062, 0.05},
                                   {0.070, 0.10},
                                   {0.050, 0.165},
                                   {0.027, 0.205},
                                   {0.027, 0.230},
                                   {0.040, 0.255}},
                                  5);
  addPart(scene, id, place, lathe(vesselProfile(side, 0.005)), material);
  return id;
}

std::uint16_t addCan(SyntheticScene& scene, const std::string& name, const Place& place,
                     const Material& material) {
  const auto id = scene.addInstance(name, true);
  addPart(scene, id, place, lathe(canProfile(0.0375, 0.0375, 0.110)), material);
  return id;
}

std::uint16_t addBottle(SyntheticScene& scene, const std::string& name, const Place& place,
                        const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  Lathe::Profile profile{{0, 0}};
  appendArc(profile, {0.030, 0.008}, 0.008, -90, 0, 4);
  const auto neck = smoothProfile({{0.038, 0.14}, {0.032, 0.175}, {0.016, 0.205}, {0.0135, 0.235}}, 5);
  profile.insert(profile.end(), neck.begin(), neck.end());
  profile.emplace_back(0.0165, 0.236);
  profile.emplace_back(0.0165, 0.258);
  profile.emplace_back(0, 0.260);
  addPart(scene, id, place, lathe(profile), material);
  return id;
}

std::uint16_t addBall(SyntheticScene& scene, const std::string& name, const Place& place, double radius,
                      const Material& material) {
  const auto id = scene.addInstance(name, true);
  addPart(scene, id, place, std::make_unique<Sphere>(radius), material, Vec3(0, 0, radius),
          turned(35, Vec3(1, 0.4, 0).normalized()));
  return id;
}

std::uint16_t addRing(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  addPart(scene, id, place, std::make_unique<Torus>(0.062, 0.026), material, Vec3(0, 0, 0.026));
  return id;
}

std::uint16_t addArch(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  addPart(scene, id, place, std::make_unique<Torus>(0.075, 0.025, 0.0), material, Vec3::Zero(),
          turned(90, Vec3::UnitX()));
  return id;
}

std::uint16_t addCarton(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                        const Material& material) {
  const auto id = scene.addInstance(name, true);
  addBox(scene, id, place, size, 0.002, material);
  return id;
}

std::uint16_t addBook(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                      const Material& material, bool upright) {
  const auto id = scene.addInstance(name, true);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (upright) {  // spine (-x) to -y, height (y) up, thickness (z) along x
    turn.col(0) = Vec3::UnitY();
    turn.col(1) = Vec3::UnitZ();
    turn.col(2) = Vec3::UnitX();
  }
  addPart(scene, id, place, std::make_unique<RoundedBox>(size / 2, 0.0015), material,
          Vec3(0, 0, (upright ? size.y() : size.z()) / 2), turn);
  return id;
}

std::uint16_t addLBlock(SyntheticScene& scene, const std::string& name, const Place& place, const Vec3& size,
                        double thickness, double radius, const Material& material) {
  const auto id = scene.addInstance(name, true, true);
  addBox(scene, id, place, {size.x(), size.y(), thickness}, radius, material);
  addBox(scene, id, place, {thickness, size.y(), size.z()}, radius, material,
         {(thickness - size.x()) / 2, 0, 0});
  return id;
}

std::uint16_t addCactus(SyntheticScene& scene, const std::string& name, const Place& place) {
  const auto id = scene.addInstance(name, true, true);
  Material pot{Pattern::plain, rgb(0xc4683f)};
  Material earth{Pattern::speckle, rgb(0x4a3628), rgb(0x6e5442), {}, 0.006F};
  Material plant{Pattern::stripes, rgb(0x3f7d4a), rgb(0x5c9e5d), {}, 0.006F};
  addPart(scene, id, place,
          lathe({{0, 0},
                 {0.036, 0},
                 {0.047, 0.062},
                 {0.054, 0.062},
                 {0.056, 0.085},
                 {0.048, 0.085},
                 {0.046, 0.074}}),
          pot);
  addPart(scene, id, place, lathe({{0, 0.05}, {0.044, 0.05}, {0.0465, 0.0745}, {0, 0.076}}), earth);
  const auto stem = [](double radius, double length) {
    Lathe::Profile profile{{0, 0}, {radius, 0}};
    appendArc(profile, {0, length - radius}, radius, 0, 90, 6);
    return lathe(profile);
  };
  addPart(scene, id, place, stem(0.029, 0.135), plant, {0, 0, 0.07});
  addPart(scene, id, place, stem(0.015, 0.060), plant, {0.015, 0, 0.125}, turned(58, Vec3::UnitY()));
  addPart(scene, id, place, stem(0.015, 0.052), plant, {0.056, 0, 0.146});
  addPart(scene, id, place, stem(0.013, 0.050), plant, {-0.012, 0.006, 0.105}, turned(-62, Vec3::UnitY()));
  return id;
}

std::uint16_t addLamp(SyntheticScene& scene, const std::string& name, const Place& place,
                      const Material& shade) {
  const auto id = scene.addInstance(name, true, true);
  Material brass{Pattern::plain, rgb(0xb08d4c)};
  brass.gloss = 0.5F;
  addPart(scene, id, place, lathe(canProfile(0.065, 0.055, 0.022, 0.006)), brass);
  addPart(scene, id, place, lathe(canProfile(0.012, 0.012, 0.25)), brass, {0, 0, 0.01});
  addPart(scene, id, place,
          lathe({{0.105, 0.215}, {0.062, 0.365}, {0.060, 0.365}, {0.103, 0.215}, {0.105, 0.215}}), shade);
  addPart(scene, id, place, lathe({{0, 0.348}, {0.0645, 0.348}, {0.063, 0.352}, {0, 0.352}}), shade);
  return id;
}

}  // namespace scantrove::synthetic
