#include "core/discovery/color_changes.h"

#include <gmock/gmock.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::kGrayLab;
using test::kRedLab;
using test::PaintedScene;

const cv::Rect kBar{40, 40, 64, 20};

ColorChanges changesOf(const PaintedScene& scene, const RegionSet& regions) {
  const DiscoveryInput input = scene.input();
  const RegionExtent extent = scene.extentOf(regions);
  const SetPixels pixels(regions, extent.box_px, input);
  return colorChangesOf(pixels, SetAxes(pixels, extent), input);
}

/// A grey object with a red part.
PaintedScene with(const cv::Rect& red) {
  PaintedScene scene;
  scene.paint(7, kBar, [](int, int) { return 1.5F; });
  scene.paint(8, red, [](int, int) { return 1.5F; });
  scene.color(1, kGrayLab);
  scene.color(7, kGrayLab);
  scene.color(8, kRedLab);
  return scene;
}

const RegionSet kBoth{RegionId{7}, RegionId{8}};

TEST(ColorChanges, ChangesAreZero_WithOneColor) {
  const PaintedScene scene = with({0, 0, 1, 1});
  const ColorChanges changes = changesOf(scene, {RegionId{7}});
  EXPECT_EQ(changes.along.contrast, 0);
  EXPECT_EQ(changes.across.contrast, 0);
  EXPECT_FLOAT_EQ(changes.along.likeness, 1);
  EXPECT_FLOAT_EQ(changes.across.likeness, 1);
}

TEST(ColorChanges, ContrastIsAlongTheAxis_ForTwoObjectsInARow) {
  // The border is at a third of the length, so equal halves would share a colour.
  const PaintedScene scene = with({kBar.x, kBar.y, 21, kBar.height});
  const ColorChanges changes = changesOf(scene, kBoth);
  EXPECT_GT(changes.along.contrast, 0.7F) << "except for rows at the outline";
  EXPECT_LT(changes.along.likeness, 0.05F);
  EXPECT_LT(changes.across.contrast, 0.15F) << "across the axis the colour is constant";
  EXPECT_GT(changes.across.likeness, 0.9F);
}

TEST(ColorChanges, ContrastIsAcrossTheAxis_ForStackedObjects) {
  const PaintedScene scene = with({kBar.x, kBar.y, kBar.width, kBar.height / 2});
  const ColorChanges changes = changesOf(scene, kBoth);
  EXPECT_GT(changes.across.contrast, 0.7F);
  EXPECT_LT(changes.across.likeness, 0.1F);
  EXPECT_LT(changes.along.contrast, 0.3F);
}

TEST(ColorChanges, ContrastIsLow_WhenALabelDoesNotSpanTheWidth) {
  const PaintedScene scene = with({kBar.x + 24, kBar.y + 6, 16, 8});
  const ColorChanges changes = changesOf(scene, kBoth);
  EXPECT_LT(changes.along.contrast, 0.5F) << "on less than half of the width";
  EXPECT_GT(changes.along.likeness, 0.6F);
}

TEST(ColorChanges, ContrastIsLow_AtARim) {
  const PaintedScene scene = with({kBar.x, kBar.y, 4, kBar.height});
  EXPECT_LT(changesOf(scene, kBoth).along.contrast, 0.1F);
}

TEST(ColorChanges, ContrastIsAlongTheAxis_WhenRegionsAreTurned) {
  PaintedScene scene;
  const Eigen::Vector2f longer = Eigen::Vector2f(1, 1).normalized(), shorter(-longer.y(), longer.x());
  for (int v = 20; v < 100; ++v) {
    for (int u = 40; u < 120; ++u) {
      const Eigen::Vector2f from_middle(static_cast<float>(u - 80), static_cast<float>(v - 60));
      if (std::abs(from_middle.dot(longer)) > 36 || std::abs(from_middle.dot(shorter)) > 10) continue;
      scene.paint(from_middle.dot(longer) > 0 ? 7 : 8, {u, v, 1, 1}, [](int, int) { return 1.5F; });
    }
  }
  scene.color(7, kGrayLab);
  scene.color(8, kRedLab);
  const ColorChanges changes = changesOf(scene, kBoth);
  EXPECT_GT(changes.along.contrast, 0.6F);
  EXPECT_LT(changes.along.likeness, 0.1F);
  EXPECT_LT(changes.across.contrast, 0.3F);
}

}  // namespace
}  // namespace scantrove
