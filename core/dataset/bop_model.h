#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <span>

#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// An object as a BOP model: its surface in an own frame, z up, with the centre of its box in the origin.
struct BopModel {
  LabeledMesh mesh_world;                                           ///< metres, world
  Eigen::Isometry3d T_world_model = Eigen::Isometry3d::Identity();  ///< metres

  /// The mesh in the model's frame.
  [[nodiscard]] LabeledMesh meshInMeters() const;
  /// The same in millimetres.
  [[nodiscard]] LabeledMesh meshInMillimeters() const;
};

/// The models of the `regions` with a surface, by region id. `up`: unit vector, world.
[[nodiscard]] std::map<std::uint32_t, BopModel> bopModelsOf(const LabeledMesh& mesh,
                                                            std::span<const LabeledRegion> regions,
                                                            const Eigen::Vector3f& up);

/// The entry of models_info.json: diameter, min_x .. size_z in mm. `mesh_mm`: of meshInMillimeters().
[[nodiscard]] ExportJson bopModelInfo(const LabeledMesh& mesh_mm);

}  // namespace scantrove
