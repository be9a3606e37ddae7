#include "core/geometry/camera_depth.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(CameraDepth, IsZInTheCameraFrame) {
  const Eigen::Isometry3d T_world_camera =
      Eigen::Translation3d(0.4, -1, 2) * Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized());
  const CameraDepth depth(T_world_camera);
  for (const Eigen::Vector3d& point_camera :
       {Eigen::Vector3d(0, 0, 1.5), Eigen::Vector3d(0.3, -0.2, 2), Eigen::Vector3d(-1, 1, -0.5)}) {
    const Eigen::Vector4f vertex_world = (T_world_camera * point_camera).cast<float>().homogeneous();
    EXPECT_NEAR(depth(vertex_world), point_camera.z(), 1e-6);
    EXPECT_EQ(depth(vertex_world), depth.row().dot(vertex_world));
  }
}

}  // namespace
}  // namespace scantrove
