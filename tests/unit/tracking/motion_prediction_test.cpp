#include "core/tracking/motion_prediction.h"

#include <gtest/gtest.h>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

TEST(PredictPose, ContinuesAtTheDampedSpeed) {
  const Eigen::Isometry3d before = pose(1, 2, 3, 0.5, 0.1, 2);
  const Eigen::Isometry3d last = before * pose(0, 2, 0, 0.1, 0, 0);
  const Eigen::Isometry3d motion = last.inverse() * predictPose(last, before, 0.5);
  EXPECT_NEAR(motion.translation().x(), 0.05, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(motion.linear()).angle(), kDegree, 1e-9);
  EXPECT_TRUE(predictPose(last, last).isApprox(last, 1e-12));
}

}  // namespace
}  // namespace scantrove::test
