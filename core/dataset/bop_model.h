#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <span>

#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// An object as BOP knows it: a surface in a frame of its own, z up, the middle of its box in the origin.
struct BopModel {
  LabeledMesh mesh_world;                                           ///< metres, world
  Eigen::Isometry3d T_world_model = Eigen::Isometry3d::Identity();  ///< metres

  /// In its own frame and millimetres.
  [[nodiscard]] LabeledMesh meshInMillimeters() const;
};

/// The models of `regions` that have a surface, by region id. `up`: unit vector of the world.
[[nodiscard]] std::map<std::uint32_t, BopModel> bopModelsOf(const LabeledMesh& mesh,
                                                            std::span<const LabeledRegion> regions,
                                                            const Eigen::Vector3f& up);

/// The entry of models_info.json: diameter, min_x .. size_z in mm. `mesh_mm`: of meshInMillimeters().
[[nodiscard]] ExportJson bopModelInfo(const LabeledMesh& mesh_mm);

}  // namespace scantrove
