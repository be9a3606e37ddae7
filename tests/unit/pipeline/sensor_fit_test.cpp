#include "core/fusion/sensor_fit.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

constexpr Intrinsics kKinectDepth{525, 525, 319.5F, 239.5F, 640, 480};
constexpr Intrinsics kPhoneDepth{213, 213, 127.5F, 95.5F, 256, 192};

FusionParams automatic() {
  FusionParams params;
  params.voxel_size_m = params.min_depth_m = params.max_depth_m = params.depth_noise_m = kAutomatic;
  return params;
}

TEST(SensorFit, GivesAKinectTheDefaults_AtUsualDistances) {
  const FusionParams usual;
  for (const std::optional<double> depth_m : {std::optional(0.7), {1.2}, {2.0}, {3.3}, {}}) {
    const FusionParams fitted = fitToSensor(automatic(), {kKinectDepth, depth_m});
    EXPECT_EQ(fitted.voxel_size_m, usual.voxel_size_m) << depth_m.value_or(0);
    EXPECT_EQ(fitted.min_depth_m, usual.min_depth_m);
    EXPECT_EQ(fitted.max_depth_m, usual.max_depth_m);
    EXPECT_EQ(fitted.depth_noise_m, usual.depth_noise_m);
  }
}

TEST(SensorFit, GivesAPhoneVoxelsThatNoPixelMisses) {
  for (const double depth_m : {0.8, 2.0, 4.0}) {
    const DepthSensor phone{kPhoneDepth, depth_m};
    const FusionParams fitted = fitToSensor(automatic(), phone);
    EXPECT_GE(static_cast<double>(fitted.voxel_size_m), phone.footprint_m()) << depth_m;
    EXPECT_LE(fitted.voxel_size_m, 0.020F) << depth_m;
    EXPECT_EQ(fitted.max_depth_m, 5) << "the LiDAR's range";
  }
  EXPECT_EQ(fitToSensor(automatic(), {kPhoneDepth, 0.5}).voxel_size_m, FusionParams{}.voxel_size_m)
      << "a board on a table, half a metre away: a pixel covers 2.3 mm";
  // 2 m / 213 px = 9.39 mm, times 1.5.
  EXPECT_FLOAT_EQ(fitToSensor(automatic(), {kPhoneDepth, 2.0}).voxel_size_m, 0.0141F);
}

TEST(SensorFit, GivesCloseUpsFinerVoxels_AndHallsCoarserOnesAndMoreRange) {
  const FusionParams close_up = fitToSensor(automatic(), {kKinectDepth, 0.4});
  EXPECT_EQ(close_up.voxel_size_m, FusionParams{}.voxel_size_m / 2);
  EXPECT_NEAR(close_up.min_depth_m, 0.4 / 3, 1e-6);
  const FusionParams hall = fitToSensor(automatic(), {kKinectDepth, 5.0});
  EXPECT_FLOAT_EQ(hall.voxel_size_m, 0.0143F) << "1.5 * 5 m / 525 px";
  EXPECT_FLOAT_EQ(hall.max_depth_m, 7.5F);
  EXPECT_EQ(fitToSensor(automatic(), {kKinectDepth, 30.0}).max_depth_m, 10);
}

TEST(SensorFit, GivesAKinectOfHalfTheResolutionTheSameVoxels) {
  const Intrinsics half = kKinectDepth.resizedTo(320, 240);
  EXPECT_EQ(fitToSensor(automatic(), {half, 2.5}).voxel_size_m, FusionParams{}.voxel_size_m);
}

TEST(SensorFit, LeavesWhatAUserSets) {
  FusionParams set = automatic();
  set.voxel_size_m = 0.004F;
  set.min_depth_m = 0;
  set.max_depth_m = 3;
  const FusionParams fitted = fitToSensor(set, {kPhoneDepth, 2.0});
  EXPECT_EQ(fitted.voxel_size_m, 0.004F);
  EXPECT_EQ(fitted.min_depth_m, 0);
  EXPECT_EQ(fitted.max_depth_m, 3);
}

}  // namespace
}  // namespace scantrove
