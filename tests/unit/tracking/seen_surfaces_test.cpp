#include "core/tracking/seen_surfaces.h"

#include <gtest/gtest.h>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

TEST(SeenSurfaces, AreDue_AtANewPoseOnly) {
  SeenSurfaces seen;
  EXPECT_TRUE(seen.isDue(pose(0, 0, 0, 0, 0, 0)));
  seen.add(pose(0, 0, 0, 0, 0, 0), {});
  EXPECT_FALSE(seen.isDue(pose(0, 3, 0, 0.03, 0, 0)));
  EXPECT_TRUE(seen.isDue(pose(0, 8, 0, 0, 0, 0))) << "8 degrees";
  EXPECT_TRUE(seen.isDue(pose(0, 0, 0, 0.12, 0, 0)));
}

TEST(SeenSurfaces, FindAView_OnlyAfterTheCameraLeftIt) {
  SeenSurfaces seen;
  seen.add(pose(0, 0, 0, 0, 0, 0), {});
  seen.markRevisitable(pose(0, 5, 0, 0, 0, 0));
  EXPECT_EQ(seen.nearestSeenAgain(pose(0, 0, 0, 0, 0, 0)), nullptr) << "the camera has not left it";
  seen.markRevisitable(pose(0, 60, 0, 0, 0, 0));
  EXPECT_NE(seen.nearestSeenAgain(pose(0, 3, 0, 0, 0, 0)), nullptr);
  EXPECT_EQ(seen.nearestSeenAgain(pose(0, 8, 0, 0, 0, 0)), nullptr) << "another view";
}

TEST(SeenSurfaces, FindTheNearestView) {
  SeenSurfaces seen;
  seen.add(pose(0, 0, 0, 0, 0, 0), {});
  seen.add(pose(0, 0, 0, 0.12, 0, 0), {});
  seen.markRevisitable(pose(0, 90, 0, 0, 0, 0));
  const SeenSurfaces::View* again = seen.nearestSeenAgain(pose(0, 0, 0, 0.08, 0, 0));
  ASSERT_NE(again, nullptr);
  EXPECT_TRUE(again->T_world_camera.isApprox(pose(0, 0, 0, 0.12, 0, 0)));
}

}  // namespace
}  // namespace scantrove::test
