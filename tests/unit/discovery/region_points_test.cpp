#include "core/discovery/region_points.h"

#include <gtest/gtest.h>

#include "core/discovery/oriented_box.h"
#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

TEST(RegionPoints, OmitsSpillThroughGaps) {
  const cv::Rect box(60, 45, 40, 30);
  const auto sizeOf = [&](const PaintedScene& scene) {
    const DiscoveryInput input = scene.input();
    return fitOrientedBox(pointsOf({RegionId{7}}, {0, 0, 160, 120}, input)).size_m.norm();
  };
  PaintedScene clean, behind, along;
  for (PaintedScene* scene : {&clean, &behind, &along}) scene->paintBump(7, box, 1.0F);
  // Points far behind the outline, and on a floor that recedes from the object's foot.
  behind.paint(7, {100, 45, 4, 25}, [](int, int) { return 1.9F; });
  along.paint(7, {100, 45, 2, 30}, [](int, int v) { return 1.0F + 0.03F * static_cast<float>(74 - v); });
  EXPECT_NEAR(sizeOf(behind), sizeOf(clean), 0.02F * sizeOf(clean));
  EXPECT_NEAR(sizeOf(along), sizeOf(clean), 0.02F * sizeOf(clean));
}

TEST(RegionPoints, KeepsAHandle) {
  PaintedScene scene;
  scene.paint(7, {60, 45, 40, 30}, [](int, int) { return 1.0F; });
  scene.paint(7, {100, 50, 12, 2}, [](int, int) { return 0.98F; });
  EXPECT_EQ(pointsOf({RegionId{7}}, {60, 45, 52, 30}, scene.input()).size(), 40U * 30 + 24);
}

TEST(RegionPoints, KeepsThinRegions) {
  PaintedScene scene;
  scene.paint(7, {40, 60, 50, 2}, [](int, int) { return 1.0F; });
  EXPECT_EQ(pointsOf({RegionId{7}}, {40, 60, 50, 2}, scene.input()).size(), 100U);
}

}  // namespace
}  // namespace scantrove
