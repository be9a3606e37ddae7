#include "core/capture/recorded_poses.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(PoseAt, InterpolatesOnly_WhenTheGapIsSmall) {
  Trajectory trajectory(3);
  trajectory[0].timestamp_s = 1.00;
  trajectory[1].timestamp_s = 1.08;
  trajectory[1].T_world_camera.translate(Eigen::Vector3d(8, 0, 0));
  trajectory[1].T_world_camera.rotate(Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitY()));
  trajectory[2].timestamp_s = 2.00;
  const auto between = poseAt(trajectory, 1.02);
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->translation().x(), 2, 1e-9);
  EXPECT_TRUE(between->linear().isApprox(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()).matrix(), 1e-9));
  EXPECT_TRUE(poseAt(trajectory, 1.095));  // 15 ms after a pose
  EXPECT_FALSE(poseAt(trajectory, 1.5));   // far from both
  EXPECT_TRUE(poseAt(trajectory, 0.985));
  EXPECT_FALSE(poseAt(trajectory, 0.97));
  EXPECT_FALSE(poseAt(trajectory, 2.03));
  EXPECT_FALSE(poseAt({}, 1.0));
}

}  // namespace
}  // namespace scantrove
