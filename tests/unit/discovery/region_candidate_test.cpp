#include "core/discovery/region_candidate.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

TEST(RegionCandidate, HasTheRegionsMaskBoxAndPlace) {
  PaintedScene scene;
  const cv::Rect box(60, 40, 30, 24);
  scene.paintBump(7, box, 1.2F);
  const std::optional<Candidate> candidate = candidateOf(RegionId{7}, scene.input(), 100);
  ASSERT_TRUE(candidate);
  EXPECT_EQ(candidate->regions, RegionSet{RegionId{7}});
  EXPECT_EQ(candidate->box_px, box);
  EXPECT_EQ(candidate->pixels, box.area());
  EXPECT_EQ(cv::countNonZero(candidate->mask), box.area());
  EXPECT_FALSE(candidate->is_complete);
  EXPECT_NEAR(candidate->size_m[0], 30 * 1.2F / 150, 0.05F);
  EXPECT_LT((scene.view.T_world_camera.cast<float>() * candidate->centroid_camera - candidate->centroid_world)
                .norm(),
            1e-5F);
  EXPECT_NEAR(candidate->centroid_camera.z(), 1.1F, 0.1F);
}

TEST(RegionCandidate, AcceptsARegion_WhenNoRuleDoes) {
  PaintedScene scene;
  EXPECT_TRUE(candidateOf(RegionId{1}, scene.input(), 100)) << "a wall cut by the image border";
}

TEST(RegionCandidate, IsNone_WhenTooFewPixelsHaveASurface) {
  PaintedScene scene;
  scene.paintBump(7, {60, 40, 9, 9}, 1.2F);
  EXPECT_FALSE(candidateOf(RegionId{7}, scene.input(), 100));
  EXPECT_TRUE(candidateOf(RegionId{7}, scene.input(), 81));
  EXPECT_FALSE(candidateOf(RegionId{8}, scene.input(), 0)) << "not in view";
  for (Eigen::Vector4f& vertex : scene.view.vertices_world) vertex.setZero();
  EXPECT_FALSE(candidateOf(RegionId{7}, scene.input(), 0)) << "labels without a surface";
}

}  // namespace
}  // namespace scantrove
