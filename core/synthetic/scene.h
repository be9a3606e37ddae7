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

/// What a ray meets. World frame.
struct RayHit {
  double distance = synthetic::kNoHit;  ///< in units of the direction's length; infinite where nothing is met
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, towards the ray's origin
  std::uint16_t instance = 0;                        ///< 0 where nothing is met
  [[nodiscard]] bool hit() const { return instance != 0; }
};

/// Solids with colours, put together in a world frame: metres, z up, floor at z = 0. Any thread, as long as
/// nobody builds or moves.
class SyntheticScene {
 public:
  struct Part {
    std::unique_ptr<synthetic::Shape> shape;
    Eigen::Isometry3d T_world_part;
    synthetic::Material material;
    std::uint16_t instance;
  };

  /// The nearest surface point `origin + distance * direction`, distance > 0, by exact geometry and brute
  /// force.
  [[nodiscard]] RayHit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  /// Ids 1, 2, 3 ... in order; 1 is the floor.
  [[nodiscard]] const std::vector<InstanceName>& instances() const { return instances_; }
  /// The id of the instance of that name; 0 where there is none.
  [[nodiscard]] std::uint16_t find(const std::string& name) const;

  /// The instance's box along the world's axes.
  [[nodiscard]] Eigen::AlignedBox3d boundsOf(std::uint16_t instance) const;

  /// Building. New instances get the next id; parts of one instance may overlap.
  std::uint16_t addInstance(std::string name, bool is_object, bool non_convex = false);
  void add(std::uint16_t instance, std::unique_ptr<synthetic::Shape> shape,
           const Eigen::Isometry3d& T_world_part, const synthetic::Material& material);

  /// Moves a part, by its place in parts().
  void setPose(std::size_t part, const Eigen::Isometry3d& T_world_part) {
    parts_[part].T_world_part = T_world_part;
  }

  /// Gives the parts away: to be put somewhere else, or into another skin.
  [[nodiscard]] std::vector<Part> takeParts() && { return std::move(parts_); }

 private:
  std::vector<Part> parts_;
  std::vector<InstanceName> instances_;
};

}  // namespace scantrove
