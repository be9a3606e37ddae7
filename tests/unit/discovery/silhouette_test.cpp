#include "core/discovery/silhouette.h"

#include <gmock/gmock.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

const cv::Rect kSquare{50, 30, 40, 40};

TEST(Silhouette, RectangleIsConvexWithReliefOfItsDistanceToTheWall) {
  PaintedScene scene;
  scene.paint(7, kSquare, [](int, int) { return 1.8F; });
  const Silhouette silhouette = silhouetteOf({RegionId{7}}, kSquare, scene.input());
  EXPECT_NEAR(silhouette.convexity, 1, 1e-3);
  EXPECT_NEAR(silhouette.relief_m, 0.2F, 1e-4);
}

TEST(Silhouette, ConvexityIsLow_ForAnL) {
  PaintedScene scene;
  scene.paint(7, kSquare, [](int, int) { return 1.8F; });
  scene.paint(1, {70, 30, 20, 20}, [](int, int) { return 2.0F; });
  // The L covers three quarters of the square; its hull lacks half of the fourth.
  EXPECT_NEAR(silhouetteOf({RegionId{7}}, kSquare, scene.input()).convexity, 0.75F / 0.875F, 0.01F);
}

TEST(Silhouette, SeveralRegionsHaveOneSilhouette) {
  PaintedScene scene;
  scene.paint(7, kSquare, [](int, int) { return 1.8F; });
  scene.paint(8, {70, 30, 20, 20}, [](int, int) { return 1.8F; });
  const Silhouette both = silhouetteOf({RegionId{7}, RegionId{8}}, kSquare, scene.input());
  EXPECT_NEAR(both.convexity, 1, 1e-3);
  EXPECT_NEAR(both.relief_m, 0.2F, 1e-4) << "the step between both is inside the outline";
}

TEST(Silhouette, ReliefIsZero_WhenLevelOrBehind) {
  PaintedScene scene;
  scene.paint(7, kSquare, [](int, int) { return 1.99F; });
  EXPECT_EQ(silhouetteOf({RegionId{7}}, kSquare, scene.input()).relief_m, 0)
      << "a step of a centimetre, like a poster's";
  scene.paint(7, kSquare, [](int, int) { return 3.0F; });
  EXPECT_EQ(silhouetteOf({RegionId{7}}, kSquare, scene.input()).relief_m, 0) << "through a window";
}

TEST(Silhouette, ReliefIsAtMostHalfAMeter) {
  PaintedScene scene;
  scene.paint(7, kSquare, [](int, int) { return 0.5F; });
  EXPECT_NEAR(silhouetteOf({RegionId{7}}, kSquare, scene.input()).relief_m, 0.5F, 1e-4);
}

TEST(Silhouette, IsNeutral_WhenTheRegionIsNotInView) {
  const PaintedScene scene;
  const Silhouette silhouette = silhouetteOf({RegionId{7}}, kSquare, scene.input());
  EXPECT_EQ(silhouette.convexity, 1);
  EXPECT_EQ(silhouette.relief_m, 0);
}

}  // namespace
}  // namespace scantrove
