#include "core/synthetic/device_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/synthetic/synthetic_source.h"
#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

using synthetic::DeviceErrors;
using synthetic::DevicePath;

/// 2 cm along the camera's z axis from frame to frame.
Eigen::Isometry3d ahead(int index) { return pose(0, 90, 0, 0.02 * index, 1, 2); }

DeviceErrors exact() { return {.scale = 1, .turn_rad_per_m = 0, .noise_m = 0, .noise_rad = 0}; }

TEST(DevicePath, IsTheTruth_WithoutErrors) {
  DevicePath path(exact(), 1, ahead);
  EXPECT_TRUE(path.pose(40).isApprox(ahead(40), 1e-9));
  EXPECT_TRUE(path.pose(3).isApprox(ahead(3), 1e-9)) << "in any order";
}

TEST(DevicePath, DriftsAlongTheWay) {
  DeviceErrors errors = exact();
  errors.scale = 1.01;
  DevicePath longer(errors, 1, ahead);
  EXPECT_NEAR((longer.pose(100).translation() - ahead(0).translation()).norm(), 1.01 * 2, 1e-9);
  errors = exact();
  errors.turn_rad_per_m = 0.01;
  DevicePath turned(errors, 1, ahead);
  const Eigen::Matrix3d turn = ahead(100).linear().transpose() * turned.pose(100).linear();
  EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), 0.01 * 2, 1e-9);
}

TEST(DevicePath, JumpsOnce) {
  DeviceErrors errors = exact();
  errors.jump_at = 10;
  errors.jump_m = 0.5;
  DevicePath path(errors, 1, ahead);
  EXPECT_TRUE(path.pose(9).isApprox(ahead(9), 1e-9));
  for (const int index : {10, 11, 50})
    EXPECT_TRUE(
        (path.pose(index).translation() - ahead(index).translation()).isApprox(Eigen::Vector3d(0.5, 0, 0)))
        << index;
}

TEST(DevicePath, HasTheNoiseThatWasAsked) {
  DeviceErrors errors = exact();
  errors.noise_m = 0.01;
  DevicePath path(errors, 7, ahead);
  double squares = 0;
  constexpr int kPoses = 3000;
  for (int i = 0; i < kPoses; ++i)
    squares += (path.pose(i).translation() - ahead(i).translation()).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / (3 * kPoses)), 0.01, 0.0005);
  DevicePath again(errors, 7, ahead);
  EXPECT_EQ(again.pose(5).matrix(), path.pose(5).matrix());
}

TEST(SyntheticSource, GivesPosesOfADevice_AndKnowsTheTrueOnes) {
  SourceOptions part;
  part.start = 30;
  part.frames = 1;
  const auto truth = makeSyntheticSource("corridor:exact", part).value(),
             device = makeSyntheticSource("corridor:exact:device", part).value();
  EXPECT_EQ(truth->info().pose_origin, PoseOrigin::truth);
  EXPECT_EQ(device->info().pose_origin, PoseOrigin::device);
  EXPECT_EQ(device->pose(30).matrix(), truth->pose(30).matrix());
  const FrameRead seen = truth->next(), by_device = device->next();
  ASSERT_TRUE(seen.frame.T_world_camera && by_device.frame.T_world_camera);
  const double apart_m =
      (seen.frame.T_world_camera->translation() - by_device.frame.T_world_camera->translation()).norm();
  EXPECT_GT(apart_m, 1e-5);
  EXPECT_LT(apart_m, 0.05);
  EXPECT_EQ(cv::countNonZero(seen.frame.depth != by_device.frame.depth), 0) << "the camera is where it is";
}

TEST(SyntheticSource, HasTheFrameRateThatWasAsked) {
  SyntheticOptions options;
  options.K = {26, 26, 15.5F, 11.5F, 32, 24};
  options.color = false;
  options.start = 12;
  options.stride = 24;
  options.frames = 100;
  options.frames_per_second = 5;
  const auto source = makeSyntheticSource(options).value();
  for (const double expected_s : {0.0, 0.2, 0.4})
    EXPECT_NEAR(source->next().frame.timestamp_s, expected_s, 1e-12);
}

}  // namespace
}  // namespace scantrove::test
