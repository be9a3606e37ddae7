#include "core/pipeline/map_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace scantrove {
namespace {

using testing::HasSubstr;

const Intrinsics kKinect{525, 525, 319.5F, 239.5F, 640, 480};
constexpr std::size_t kGiB = std::size_t{1} << 30;

TEST(BricksOfOneView, GrowWithTheSquaresOfRangeAndResolution) {
  FusionParams params;
  const double usual = bricksOfOneView(params, kKinect);
  EXPECT_NEAR(usual, 2 * (640 * 5.0 / 525) * (480 * 5.0 / 525) / std::pow(8 * 3.0 / 512, 2), 1);
  params.voxel_size_m /= 2;
  EXPECT_NEAR(bricksOfOneView(params, kKinect), 4 * usual, 1);
  params.max_depth_m /= 2;
  EXPECT_NEAR(bricksOfOneView(params, kKinect), usual, 1);
}

TEST(CheckMapFits, AcceptsTheDefaultMap_OnASmallDevice) {
  EXPECT_TRUE(checkMapFits({}, kKinect, {kGiB, kGiB / 4}));
}

TEST(CheckMapFits, AdvisesValuesThatFit_WhenTheMapIsTooLarge) {
  const DeviceMemory memory{4 * kGiB, kGiB};
  FusionParams params;
  params.voxel_size_m = 0.001F;
  const Result<void> refused = checkMapFits(params, kKinect, memory);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("voxels of 1.0 mm does not fit"));
  const std::string& advice = refused.error().advice;
  const auto numberAfter = [&](const std::string& key) {
    const std::size_t at = advice.find(key + "=");
    return at == std::string::npos ? 0.0F : std::stof(advice.substr(at + key.size() + 1));
  };
  FusionParams larger = params;
  larger.voxel_size_m = numberAfter("fusion.voxel_size_m");
  EXPECT_TRUE(checkMapFits(larger, kKinect, memory)) << advice;
  larger.voxel_size_m -= 0.00011F;
  EXPECT_FALSE(checkMapFits(larger, kKinect, memory)) << "voxels a tenth of a millimetre smaller also fit";
  FusionParams nearer = params;
  nearer.max_depth_m = numberAfter("fusion.max_depth_m");
  EXPECT_TRUE(checkMapFits(nearer, kKinect, memory)) << advice;
}

TEST(VoxelSizeFor, Doubles_WhenTheSurfaceQuadruples) {
  EXPECT_DOUBLE_EQ(voxelSizeFor(4, 0.002), 0.004);
  EXPECT_DOUBLE_EQ(voxelSizeFor(2, 0.001), 0.0015);  // 1.41 mm, rounded up
}

}  // namespace
}  // namespace scantrove
