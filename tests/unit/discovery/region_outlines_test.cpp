#include "core/discovery/region_outlines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;
using testing::Contains;
using testing::Not;

OutlineSteps outlineOf(const PaintedScene& scene, std::uint32_t region) {
  return RegionOutlines(scene.input()).of({RegionId{region}});
}

TEST(RegionOutlines, OutlineIsOpen_ForAFreeStandingObject) {
  PaintedScene scene;
  scene.paint(7, {60, 50, 40, 30}, [](int, int) { return 1.0F; });
  const OutlineSteps steps = outlineOf(scene, 7);
  EXPECT_EQ(steps.open, 2 * (40 + 30)) << "a metre before the wall, all around";
  EXPECT_EQ(steps.known(), steps.open);
  EXPECT_EQ(steps.own(), 1);
  // From the wall's side the same steps are hidden; the wall also ends at the image edges.
  const OutlineSteps wall = outlineOf(scene, 1);
  EXPECT_EQ(wall.hidden, 2 * (40 + 30));
  EXPECT_EQ(wall.cut, 2 * (160 + 120));
  EXPECT_EQ(wall.own(), 0);
}

TEST(RegionOutlines, OutlineIsSmooth_ForAPatchOfAPlane) {
  PaintedScene scene;
  scene.paint(7, {60, 50, 40, 30}, [](int, int) { return 2.0F; });
  const OutlineSteps steps = outlineOf(scene, 7);
  EXPECT_EQ(steps.smooth, 2 * (40 + 30));
  EXPECT_EQ(steps.own(), 0);
}

TEST(RegionOutlines, OutlineIsOpen_ForABookOnATable) {
  PaintedScene scene;  // from above, 2 cm thick: less than the step that hides
  scene.paint(1, {0, 0, 160, 120}, [](int, int) { return 1.0F; });
  scene.paint(7, {60, 50, 40, 30}, [](int, int) { return 0.98F; });
  EXPECT_EQ(outlineOf(scene, 7).open, 2 * (40 + 30));
  EXPECT_EQ(outlineOf(scene, 1).hidden, 2 * (40 + 30)) << "the table continues below it";
}

/// Two planes that meet in the column u = 80, nearer or farther there than to the sides.
PaintedScene roof(float slope) {
  PaintedScene scene;
  const auto depth = [slope](int u, int) {
    return 1.5F + slope * std::abs(static_cast<float>(u) - 79.5F) / 150;
  };
  scene.paint(2, {40, 20, 40, 80}, depth);
  scene.paint(3, {80, 20, 40, 80}, depth);
  return scene;
}

TEST(RegionOutlines, DistinguishesFoldsAndRidges) {
  const auto between = [](const PaintedScene& scene) {
    return RegionOutlines(scene.input()).between(RegionId{2}, RegionId{3});
  };
  const OutlineSteps ridge = between(roof(0.8F));  // the edge is nearest
  EXPECT_EQ(ridge.ridged, 80);
  EXPECT_EQ(ridge.touching(), 80);
  const OutlineSteps fold = between(roof(-0.8F));
  EXPECT_EQ(fold.folded, 80);
  EXPECT_EQ(fold.touching(), 80);
}

TEST(RegionOutlines, OutlineOmitsStepsInsideASet) {
  const PaintedScene scene = roof(0.8F);
  const RegionOutlines outlines(scene.input());
  const RegionId a{2}, b{3};
  EXPECT_EQ(outlines.of({a}).ridged, 80);
  EXPECT_EQ(outlines.of({a, b}).ridged, 0);
  EXPECT_EQ(outlines.of({a, b}).known(), 2 * (80 + 80)) << "only the rectangle around both";
  EXPECT_THAT(outlines.touchedBy(a, 80), Contains(b));
  EXPECT_THAT(outlines.touchedBy(a, 81), Not(Contains(b)));
}

TEST(RegionOutlines, StepsAreUnseen_WithoutSurface) {
  PaintedScene scene;
  scene.paint(7, {60, 50, 40, 30}, [](int, int) { return 1.0F; });
  for (int v = 0; v < 120; ++v) {
    for (int u = 100; u < 110; ++u)
      scene.view.vertices_world[static_cast<std::size_t>(v * 160 + u)].setZero();
  }
  const OutlineSteps steps = outlineOf(scene, 7);
  EXPECT_EQ(steps.unseen, 30);
  EXPECT_EQ(steps.open, 2 * (40 + 30) - 30);
  EXPECT_EQ(steps.own(), 1);
}

}  // namespace
}  // namespace scantrove
