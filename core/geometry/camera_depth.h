#pragma once
#include <Eigen/Geometry>

namespace scantrove {

/// Depth of world points: their z in the frame of a camera.
class CameraDepth {
 public:
  explicit CameraDepth(const Eigen::Isometry3d& T_world_camera)
      : row_(T_world_camera.inverse().matrix().row(2).cast<float>()) {}

  /// `vertex_world`: (x, y, z, 1).
  [[nodiscard]] float operator()(const Eigen::Vector4f& vertex_world) const { return row_.dot(vertex_world); }
  /// The depth of a point is the product of this row and (x, y, z, 1).
  [[nodiscard]] const Eigen::RowVector4f& row() const { return row_; }

 private:
  Eigen::RowVector4f row_;
};

}  // namespace scantrove
