#include "tests/render/scene_fixture.h"

namespace scantrove {
namespace {

using test::kVoxel_m;
using test::SceneTest;

/// A scene with a wall at 1 m and a wall behind it.
class CloudPickTest : public SceneTest {
 protected:
  static std::vector<CloudBrick> wallBehind(std::uint32_t fragment, int voxels_behind) {
    std::vector<CloudBrick> bricks = wall(128, fragment, fragment);
    for (CloudBrick& brick : bricks) {
      brick.position.z() += voxels_behind / 8;
      for (CloudBrick::Point& p : brick.points) p.z += kVoxel_m * static_cast<float>(voxels_behind);
    }
    return bricks;
  }

  static constexpr float kPixel_rad = 0.001F;
  static constexpr int kWallVoxel = static_cast<int>(1.0F / kVoxel_m);
  static constexpr float kWall_m = kVoxel_m * static_cast<float>(kWallVoxel);
};

TEST_F(CloudPickTest, PicksTheNearestSurface_AlongTheRay) {
  show(wallBehind(2, 40), {{0}, {7}, {9}});
  const auto behind = scene_.cloud().pick({0, 0, 0}, {0.02F, 0.03F, 1}, kPixel_rad);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->z(), kWall_m + 40 * kVoxel_m, 1e-4);
  show(wall(64, 1, 1), {{0}, {7}, {9}});
  const auto picked = scene_.cloud().pick({0, 0, 0}, {0.02F, 0.03F, 1}, kPixel_rad);
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->z(), kWall_m, 1e-4);
  EXPECT_NEAR(picked->x(), 0.02F * kWall_m, kVoxel_m);
  EXPECT_NEAR(picked->y(), 0.03F * kWall_m, kVoxel_m);
  // From the other side, the far wall is the nearest.
  const auto reverse = scene_.cloud().pick({0, 0, 3}, {0, 0, -1}, kPixel_rad);
  ASSERT_TRUE(reverse);
  EXPECT_NEAR(reverse->z(), kWall_m + 40 * kVoxel_m, 1e-4);
}

TEST_F(CloudPickTest, PicksNothing_BesideAndBehindTheCamera) {
  EXPECT_FALSE(scene_.cloud().pick({0, 0, 0}, {0, 0, 1}, kPixel_rad));
  show(wall(64, 1, 1), {{0}, {7}, {9}});
  EXPECT_FALSE(scene_.cloud().pick({0, 0, 0}, {0, 0, -1}, kPixel_rad));
  EXPECT_FALSE(scene_.cloud().pick({0, 0, 2}, {0, 0, 1}, kPixel_rad));
  EXPECT_FALSE(scene_.cloud().pick({0, 0, 0}, {1, 0, 1}, kPixel_rad));
  // A few voxels beyond the edge (32 voxels from the middle), but within a coarse pixel.
  const Eigen::Vector3f aside(36 * kVoxel_m, 0, kWall_m);
  EXPECT_FALSE(scene_.cloud().pick({0, 0, 0}, aside, kPixel_rad));
  EXPECT_TRUE(scene_.cloud().pick({0, 0, 0}, aside, 0.05F));
}

TEST_F(CloudPickTest, IgnoresHiddenRegions) {
  show(wallBehind(2, 40), {{0}, {7}, {9}});
  show(wall(64, 1, 1), {{0}, {7}, {9}});
  scene_.setBackground({RegionId{7}}, BackgroundStyle::hidden);
  const auto picked = scene_.cloud().pick({0, 0, 0}, {0, 0, 1}, kPixel_rad);
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->z(), kWall_m + 40 * kVoxel_m, 1e-4);
  scene_.setBackground({RegionId{7}}, BackgroundStyle::dimmed);
  EXPECT_NEAR(scene_.cloud().pick({0, 0, 0}, {0, 0, 1}, kPixel_rad)->z(), kWall_m, 1e-4);
}

TEST_F(CloudPickTest, PicksAtAPixelAndIgnoresClippedSurface) {
  show(wallBehind(2, 40), {{0}, {7}, {9}});
  show(wall(64, 1, 1), {{0}, {7}, {9}});
  render();
  const Eigen::Vector3f point(0.1F, -0.05F, kWall_m);
  const auto position = scene_.viewpoint().positionOf(point, 1);
  ASSERT_TRUE(position);
  EXPECT_GT(position->x(), 0);
  EXPECT_GT(position->y(), 0) << "y points down";
  const auto picked = scene_.pick(position->x(), position->y(), test::kSize, test::kSize);
  ASSERT_TRUE(picked);
  EXPECT_LT((*picked - point).norm(), 1.5F * kVoxel_m);
  scene_.setClipDistance(0.1F);
  EXPECT_NEAR(scene_.clipDistance().value(), 1.1F, 1e-4);
  const auto behind = scene_.pick(position->x(), position->y(), test::kSize, test::kSize);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->z(), kWall_m + 40 * kVoxel_m, 1e-4);
}

TEST_F(CloudPickTest, GivesTheBoundsOfRegions) {
  show(wall(64, 1, 2), {{0}, {7}, {9}});
  const Eigen::AlignedBox3f left = scene_.cloud().boundsOf({RegionId{7}});
  EXPECT_NEAR(left.min().x(), -32 * kVoxel_m, 1e-4);
  EXPECT_NEAR(left.max().x(), -kVoxel_m, 1e-4);
  const Eigen::AlignedBox3f both = scene_.cloud().boundsOf({RegionId{7}, RegionId{9}});
  EXPECT_TRUE(both.min().isApprox(scene_.cloud().bounds().min()));
  EXPECT_TRUE(both.max().isApprox(scene_.cloud().bounds().max()));
  EXPECT_TRUE(scene_.cloud().boundsOf({RegionId{8}}).isEmpty());
  EXPECT_TRUE(scene_.cloud().boundsOf({}).isEmpty());
}

}  // namespace
}  // namespace scantrove
