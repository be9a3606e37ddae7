#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/instance_name.h"
#include "core/synthetic/material.h"
#include "core/synthetic/shape.h"

namespace scantrove {

/// Surface point that a ray hits. World frame.
struct RayHit {
  double distance = synthetic::kNoHit;  ///< in units of the direction's length; infinite without a hit
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, towards the ray's origin
  std::uint16_t instance = 0;                        ///< 0 without a hit
  [[nodiscard]] bool hit() const { return instance != 0; }
};

/// Coloured solids in a world frame: metres, z up, floor at z = 0. Any thread, unless another one builds or
/// moves parts.
class SyntheticScene {
 public:
  struct Part {
    std::unique_ptr<synthetic::Shape> shape;
    Eigen::Isometry3d T_world_part;
    synthetic::Material material;
    std::uint16_t instance;
  };

  /// The nearest surface point `origin + distance * direction`, distance > 0, by exact brute-force
  /// intersection.
  [[nodiscard]] RayHit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  /// Ids 1, 2, 3 ... in order; 1 is the floor.
  [[nodiscard]] const std::vector<InstanceName>& instances() const { return instances_; }
  /// The id of the named instance; 0 if there is none.
  [[nodiscard]] std::uint16_t find(const std::string& name) const;

  /// The instance's box along the world's axes.
  [[nodiscard]] Eigen::AlignedBox3d boundsOf(std::uint16_t instance) const;

  /// Building: new instances get the next id; parts of one instance may overlap.
  std::uint16_t addInstance(std::string name, bool is_object, bool non_convex = false);
  void add(std::uint16_t instance, std::unique_ptr<synthetic::Shape> shape,
           const Eigen::Isometry3d& T_world_part, const synthetic::Material& material);

  /// Moves a part, given by its index in parts().
  void setPose(std::size_t part, const Eigen::Isometry3d& T_world_part) {
    parts_[part].T_world_part = T_world_part;
  }

  /// Releases the parts, to be placed elsewhere or given other materials.
  [[nodiscard]] std::vector<Part> takeParts() && { return std::move(parts_); }

 private:
  std::vector<Part> parts_;
  std::vector<InstanceName> instances_;
};

}  // namespace scantrove
