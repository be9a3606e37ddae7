#include "core/tracking/device_motion.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

using Support = DeviceMotion::Support;

constexpr double kWalking_mps = 1.4;

/// A device that walks along x from `start_m`, at `rate_hz`.
struct Walk {
  double rate_hz = 30;
  double speed_mps = kWalking_mps;
  double start_m = 0;

  [[nodiscard]] double time_s(int frame) const { return 100 + frame / rate_hz; }
  [[nodiscard]] Eigen::Isometry3d device(int frame) const {
    return pose(0, 0, 0, start_m + speed_mps * frame / rate_hz, 0, 0);
  }
};

/// The device's poses of `frames` frames, all of which the map confirms where the device has them.
DeviceMotion followed(const Walk& walk, int frames, Support support = Support::firm) {
  DeviceMotion motion;
  for (int i = 0; i < frames; ++i) motion.update(walk.device(i), walk.time_s(i), walk.device(i), support);
  return motion;
}

double distance_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

TEST(DeviceMotion, PredictsNothing_BeforeAFrameOfTheMap) {
  EXPECT_FALSE(DeviceMotion().predict(pose(0, 0, 0, 1, 2, 3), 1));
}

TEST(DeviceMotion, AppliesTheDevicesMotionToTheLastPoseOfTheMap) {
  DeviceMotion motion;
  const Eigen::Isometry3d by_device = pose(5, -20, 8, 1, 2, 3), by_map = pose(-3, 40, 2, 0.2, -0.1, 0.4);
  motion.update(by_device, 7, by_map, Support::firm);
  const Eigen::Isometry3d step = pose(2, 7, -1, 0.3, 0.02, 0.5);
  const auto prediction = motion.predict(by_device * step, 7.2);
  ASSERT_TRUE(prediction);
  EXPECT_TRUE(prediction->T_world_camera.isApprox(by_map * step, 1e-12));
  EXPECT_FALSE(prediction->T_world_jumped);
}

// 5 Hz and 0.6 m apart: a device in the hand of someone who hurries.
TEST(DeviceMotion, HoldsOverWideSteps) {
  const Walk hurry{.rate_hz = 5, .speed_mps = 3};
  const DeviceMotion motion = followed(hurry, 5);
  const auto prediction = motion.predict(hurry.device(5), hurry.time_s(5));
  ASSERT_TRUE(prediction);
  EXPECT_FALSE(prediction->T_world_jumped);
  EXPECT_LT(distance_m(prediction->T_world_camera, hurry.device(5)), 1e-9);
}

TEST(DeviceMotion, HoldsOverWideSteps_WhenTimesAreUnknown) {
  DeviceMotion motion;
  double along_m = 0;
  for (const double step_m : {0.0, 0.5, 0.6, 0.7, 0.6, 0.65, 0.6}) {
    const Eigen::Isometry3d device = pose(0, 0, 0, along_m += step_m, 0, 0);
    if (const auto prediction = motion.predict(device, 0)) {
      EXPECT_FALSE(prediction->T_world_jumped) << along_m;
    }
    motion.update(device, 0, device, Support::firm);
  }
}

TEST(DeviceMotion, AllowsMore_TheFartherItMovedUnconfirmed) {
  const Walk walk;
  const auto allowed = [&](Support support, int frames) {
    return followed(walk, frames, support).predict(walk.device(frames), walk.time_s(frames))->noise;
  };
  const ViewReach confirmed = allowed(Support::firm, 60), near = allowed(Support::none, 30),
                  far = allowed(Support::none, 60);
  EXPECT_NEAR(confirmed.distance_m, 0.03 + 0.03 * kWalking_mps / 30, 1e-9) << "noise, and one step of drift";
  EXPECT_NEAR(near.distance_m, 0.03 + 0.03 * kWalking_mps, 1e-9) << "3 cm a metre";
  EXPECT_NEAR(far.distance_m, 0.03 + 0.03 * 2 * kWalking_mps, 1e-9);
  EXPECT_GT(far.angle_rad, near.angle_rad);
  EXPECT_NEAR(allowed(Support::partial, 60).distance_m, far.distance_m, 1e-9)
      << "directions that the map does not determine drift on";
  EXPECT_LE(allowed(Support::none, 3000).distance_m, 0.6) << "not without end";
}

TEST(DeviceMotion, AgreesWithinItsNoise_AndMoreWithAFirmPose) {
  const Walk walk;
  const auto prediction = followed(walk, 5).predict(walk.device(5), walk.time_s(5));
  ASSERT_TRUE(prediction);
  const auto beside = [&](double x_m) { return pose(0, 0, 0, x_m, 0, 0) * prediction->T_world_camera; };
  EXPECT_TRUE(prediction->agrees(beside(0.02), false));
  EXPECT_FALSE(prediction->agrees(beside(0.08), false));
  EXPECT_TRUE(prediction->agrees(beside(0.08), true)) << "the device corrected itself";
  EXPECT_FALSE(prediction->agrees(beside(0.2), true));
  EXPECT_FALSE(prediction->agrees(prediction->T_world_camera * pose(0, 6, 0, 0, 0, 0), true));
}

TEST(DeviceMotion, DetectsAJump_AtWalkingSpeed) {
  for (const double rate_hz : {60.0, 30.0, 10.0, 5.0}) {
    SCOPED_TRACE(rate_hz);
    const Walk walk{.rate_hz = rate_hz};
    DeviceMotion motion = followed(walk, 8);
    for (const Eigen::Isometry3d& jump : {pose(0, 0, 0, 0.3, 0, 0), pose(0, 0, 0, 0, 0.3, 0),
                                          pose(0, 0, 0, -0.21, 0, 0.22), pose(0, 40, 0, 0, 0, 0)}) {
      const auto prediction = motion.predict(jump * walk.device(8), walk.time_s(8));
      ASSERT_TRUE(prediction && prediction->T_world_jumped);
      EXPECT_TRUE(prediction->T_world_jumped->isApprox(jump * walk.device(8), 1e-9));
      EXPECT_LT(distance_m(prediction->T_world_camera, walk.device(8)), 1e-9) << "it walks on";
    }
  }
}

// The pose of the frame that jumped keeps the camera in its place; from there on the device is right again.
TEST(DeviceMotion, ContinuesFromTheMapsPose_AfterAJump) {
  const Walk walk;
  DeviceMotion motion = followed(walk, 8);
  const Eigen::Isometry3d jump = pose(0, 3, 0, 0.5, 0, 0.1);
  for (int i = 8; i < 12; ++i) {
    const Eigen::Isometry3d device = jump * walk.device(i);
    const auto prediction = motion.predict(device, walk.time_s(i));
    ASSERT_TRUE(prediction);
    EXPECT_EQ(prediction->T_world_jumped.has_value(), i == 8) << i;
    EXPECT_LT(distance_m(prediction->T_world_camera, walk.device(i)), 1e-9) << i;
    EXPECT_GT(prediction->noise.distance_m, 0.5) << "unconfirmed since";
    motion.update(device, walk.time_s(i), prediction->T_world_camera, Support::none);
  }
}

TEST(DeviceMotion, DetectsBothJumps_WhenOnePoseIsWrong) {
  const Walk walk;
  DeviceMotion motion = followed(walk, 8);
  const Eigen::Isometry3d wrong = pose(0, 0, 0, 0, 0.4, 0) * walk.device(8);
  ASSERT_TRUE(motion.predict(wrong, walk.time_s(8))->T_world_jumped);
  motion.update(wrong, walk.time_s(8), walk.device(8), Support::firm);
  const auto back = motion.predict(walk.device(9), walk.time_s(9));
  ASSERT_TRUE(back->T_world_jumped);
  EXPECT_LT(distance_m(back->T_world_camera, walk.device(9)), 1e-9);
}

// A camera that is jerked from rest goes on at its new speed.
TEST(DeviceMotion, BelievesASecondMotionLikeTheJump) {
  DeviceMotion motion = followed({.speed_mps = 0}, 5);
  const Walk jerked{.speed_mps = 12};
  ASSERT_TRUE(motion.predict(jerked.device(1), 100 + 5 / 30.0)->T_world_jumped);
  motion.update(jerked.device(1), 100 + 5 / 30.0, jerked.device(1), Support::none);
  EXPECT_FALSE(motion.predict(jerked.device(2), 100 + 6 / 30.0)->T_world_jumped);
}

TEST(DeviceMotion, ExpectsACameraToPan_WhileItWalksOn) {
  DeviceMotion motion;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Isometry3d device = pose(0, 30 * i, 0, 0.6 * i, 0, 0);
    if (const auto prediction = motion.predict(device, 0.2 * i)) {
      EXPECT_FALSE(prediction->T_world_jumped) << i;
    }
    motion.update(device, 0.2 * i, device, Support::firm);
  }
  const Eigen::Isometry3d next = pose(0, 30 * 8, 0, 0.6 * 8, 0, 0);
  const auto jumped = motion.predict(pose(0, 0, 0, 0, 0, 0.6) * next, 1.6);
  ASSERT_TRUE(jumped && jumped->T_world_jumped);
  EXPECT_TRUE(jumped->T_world_camera.isApprox(next, 1e-9));
}

TEST(DeviceMotion, ComparesSpeeds_WhenFramesAreMissing) {
  const Walk walk;
  const DeviceMotion motion = followed(walk, 8);
  EXPECT_FALSE(motion.predict(walk.device(14), walk.time_s(14))->T_world_jumped);
  EXPECT_FALSE(motion.predict(walk.device(100), walk.time_s(100))->T_world_jumped) << "a pause";
}

// The device's world turns against the map's by 0.2 degrees a metre. Each prediction uses only one step of
// it.
TEST(DeviceMotion, FollowsTheDriftOfTheDevice) {
  DeviceMotion motion;
  for (int i = 0; i < 300; ++i) {
    const double along_m = 0.05 * i;
    const Eigen::Isometry3d by_map = pose(0, 0, 0, 0, 0, along_m);
    const Eigen::Isometry3d by_device = pose(0, 0.2 * along_m, 0, 0.002 * along_m, 0, 1.01 * along_m);
    if (const auto prediction = motion.predict(by_device, i / 30.0)) {
      EXPECT_LT(distance_m(prediction->T_world_camera, by_map), 0.005) << i;
      EXPECT_TRUE(prediction->agrees(by_map, false)) << i;
    }
    motion.update(by_device, i / 30.0, by_map, Support::firm);
  }
}

TEST(DeviceMotion, PredictsEqually_WhenRestored) {
  const Walk walk;
  const DeviceMotion motion = followed(walk, 8, Support::partial);
  DeviceMotion restored;
  ASSERT_TRUE(motion.memory());
  restored.restore(*motion.memory());
  const auto a = motion.predict(walk.device(8), walk.time_s(8)),
             b = restored.predict(walk.device(8), walk.time_s(8));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->T_world_camera.matrix(), b->T_world_camera.matrix());
  EXPECT_EQ(a->noise.distance_m, b->noise.distance_m);
  restored.forget();
  EXPECT_FALSE(restored.predict(walk.device(8), walk.time_s(8)));
}

}  // namespace
}  // namespace scantrove::test
