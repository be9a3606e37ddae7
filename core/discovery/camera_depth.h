#pragma once
#include <Eigen/Geometry>

namespace scantrove {

/// z in the camera frame of world points.
class CameraDepth {
 public:
  explicit CameraDepth(const Eigen::Isometry3d& T_world_camera) {
    const Eigen::Matrix4f T_camera_world = T_world_camera.inverse().matrix().cast<float>();
    axis_ = T_camera_world.block<1, 3>(2, 0).transpose();
    offset_ = T_camera_world(2, 3);
  }
  [[nodiscard]] float operator()(const Eigen::Vector4f& vertex) const {
    return axis_.dot(vertex.head<3>()) + offset_;
  }

 private:
  Eigen::Vector3f axis_;
  float offset_;
};

}  // namespace scantrove
