#include "core/dataset/bop_model.h"

#include <utility>

#include "core/dataset/mesh_parts.h"
#include "core/dataset/up_direction.h"

namespace scantrove {
namespace {

constexpr float kMillimeters = 1000;

}  // namespace

LabeledMesh BopModel::meshInMeters() const {
  return transformed(mesh_world, Eigen::Affine3f(T_world_model.inverse().cast<float>().matrix()));
}

LabeledMesh BopModel::meshInMillimeters() const {
  const Eigen::Affine3f T(Eigen::Scaling(kMillimeters) *
                          Eigen::Affine3f(T_world_model.inverse().cast<float>().matrix()));
  return transformed(mesh_world, T);
}

std::map<std::uint32_t, BopModel> bopModelsOf(const LabeledMesh& mesh, std::span<const LabeledRegion> regions,
                                              const Eigen::Vector3f& up) {
  std::map<std::uint32_t, BopModel> models;
  const Eigen::Affine3f upright = turning(up, Eigen::Vector3f::UnitZ());
  for (auto& [region, part] : splitByRegion(mesh, regions)) {
    if (region == 0) continue;
    BopModel& model = models[region];
    const Eigen::Vector3f middle = boxOf(transformed(part, upright)).center();
    model.mesh_world = std::move(part);
    model.T_world_model.linear() = upright.linear().transpose().cast<double>();
    model.T_world_model.translation() = model.T_world_model.linear() * middle.cast<double>();
  }
  return models;
}

ExportJson bopModelInfo(const LabeledMesh& mesh_mm) {
  const Eigen::AlignedBox3f box = boxOf(mesh_mm);
  const Eigen::Vector3f size = box.sizes();
  return {{"diameter", diameterOf(mesh_mm)},
          {"min_x", box.min().x()},
          {"min_y", box.min().y()},
          {"min_z", box.min().z()},
          {"size_x", size.x()},
          {"size_y", size.y()},
          {"size_z", size.z()}};
}

}  // namespace scantrove
