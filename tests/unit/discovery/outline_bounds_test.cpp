#include "core/discovery/outline_bounds.h"

#include <gmock/gmock.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::kGrayLab;
using test::kRedLab;
using test::PaintedScene;

const cv::Rect kStanding{50, 40, 40, 20};

OutlineBounds boundsOf(const PaintedScene& scene, const RegionSet& regions) {
  const DiscoveryInput input = scene.input();
  const RegionExtent extent = scene.extentOf(regions);
  const SetPixels pixels(regions, extent.box_px, input);
  return outlineBoundsOf(pixels, SetAxes(pixels, extent), input);
}

// Each mean includes three neutral steps.
TEST(OutlineBounds, AllSidesAreBounded_InFrontOfAWall) {
  PaintedScene scene;
  scene.paint(7, kStanding, [](int, int) { return 1.5F; });
  const OutlineBounds bounds = boundsOf(scene, {RegionId{7}});
  EXPECT_FLOAT_EQ(bounds.mean, (120 + 1.5F) / 123);
  EXPECT_GT(bounds.least_side, 0.9F);
}

TEST(OutlineBounds, PatchOfAWallIsBounded_OnlyByItsColor) {
  PaintedScene scene;
  scene.paint(7, kStanding, [](int, int) { return 2.0F; });
  scene.color(1, kGrayLab);
  scene.color(7, kGrayLab);
  EXPECT_FLOAT_EQ(boundsOf(scene, {RegionId{7}}).mean, 1.5F / 123);
  scene.color(7, kRedLab);
  EXPECT_FLOAT_EQ(boundsOf(scene, {RegionId{7}}).mean, (120 + 1.5F) / 123);
}

TEST(OutlineBounds, LeastSideIsTowardsTheOtherHalf_OfOneObject) {
  PaintedScene scene;
  scene.paint(7, kStanding, [](int, int) { return 1.5F; });
  scene.paint(8, {kStanding.br().x, kStanding.y, kStanding.width, kStanding.height},
              [](int, int) { return 1.5F; });
  for (const std::uint32_t region : {1U, 7U, 8U}) scene.color(region, kGrayLab);
  const OutlineBounds half = boundsOf(scene, {RegionId{7}});
  EXPECT_NEAR(half.mean, 100.0F / 120, 0.02F);
  EXPECT_LT(half.least_side, 0.2F);
  const OutlineBounds both = boundsOf(scene, {RegionId{7}, RegionId{8}});
  EXPECT_GT(both.least_side, 0.9F) << "the border between them is inside";
  scene.color(8, kRedLab);
  EXPECT_GT(boundsOf(scene, {RegionId{7}}).least_side, 0.8F) << "two objects in a row";
}

TEST(OutlineBounds, SideIsNeutral_WhenHidden) {
  PaintedScene scene;
  scene.paint(7, kStanding, [](int, int) { return 1.5F; });
  const OutlineBounds before = boundsOf(scene, {RegionId{7}});
  scene.paint(8, {kStanding.br().x, kStanding.y - 10, 20, 40}, [](int, int) { return 1.0F; });
  const OutlineBounds bounds = boundsOf(scene, {RegionId{7}});
  EXPECT_NEAR(bounds.mean, before.mean, 0.01F);
  EXPECT_FLOAT_EQ(bounds.least_side, 0.5F) << "this side is unknown";
}

TEST(OutlineBounds, ContinuingSurfaceIsNeutral_WithoutColor) {
  PaintedScene scene;
  scene.paint(7, kStanding, [](int, int) { return 2.0F; });
  const float mean = boundsOf(scene, {RegionId{7}}).mean;
  EXPECT_GT(mean, 0.2F);
  EXPECT_LT(mean, 0.6F);
}

TEST(OutlineBounds, IsNeutral_WhenTheRegionIsNotInView) {
  const OutlineBounds bounds = boundsOf(PaintedScene(), {RegionId{7}});
  EXPECT_FLOAT_EQ(bounds.mean, 0.5F);
  EXPECT_FLOAT_EQ(bounds.least_side, 0.5F);
}

}  // namespace
}  // namespace scantrove
