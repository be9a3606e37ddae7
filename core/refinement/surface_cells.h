#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <vector>

namespace scantrove {

/// The planar part of a surface.
struct PlanarPart {
  Eigen::Vector3f normal_world;               ///< unit, out of the surface
  std::vector<Eigen::Vector3f> points_world;  ///< one for each cell of SurfaceCells, m
  Eigen::AlignedBox3f box_world;              ///< of the points
};

/// Whether one surface continues the other in its plane: their normals differ by at most 5 degrees. They
/// touch, or about 30 cm lie between them, and their heights differ by at most 2 cm where they are nearest.
[[nodiscard]] bool continuesInPlane(const PlanarPart& a, const PlanarPart& b);

/// The surface of a region in cells of 5 cm. One thread.
class SurfaceCells {
 public:
  /// Adds a point (world, m) with its unit normal; a normal of 0 is unknown, and the point is ignored.
  void add(const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal_world);
  /// The cells that face the same way as the surface does on average; none: they are less than 70 %.
  [[nodiscard]] std::optional<PlanarPart> planarPart() const;

 private:
  struct Cell {
    Eigen::Vector3f points = Eigen::Vector3f::Zero(), normals = Eigen::Vector3f::Zero();  // sums
    int count = 0;
  };
  std::map<std::array<int, 3>, Cell> cells_;  // in order, so that sums are always the same
};

}  // namespace scantrove
