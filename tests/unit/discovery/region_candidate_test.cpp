#include "core/discovery/region_candidate.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

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

TEST(CandidatesOfSets, AreTheSetsInView_WithTheirOutlines) {
  PaintedScene scene;
  scene.paintBump(7, {30, 40, 20, 24}, 1.2F);
  scene.paintBump(8, {50, 40, 20, 24}, 1.2F);
  scene.paintBump(9, {100, 50, 5, 5}, 1.2F);
  const std::vector<RegionSet> sets{{RegionId{7}, RegionId{8}}, {RegionId{9}}, {RegionId{70}}};
  const std::vector<Candidate> candidates = candidatesOf(sets, scene.input(), 100);
  ASSERT_EQ(candidates.size(), 1U) << "one is small, one is not in view";
  EXPECT_EQ(candidates[0].regions, sets[0]);
  EXPECT_EQ(candidates[0].box_px, cv::Rect(30, 40, 40, 24));
  EXPECT_EQ(candidates[0].pixels, 40 * 24);
  EXPECT_GT(candidates[0].outline, 0.9F) << "it ends at depth edges";
  EXPECT_EQ(candidates[0].hidden, 0);
  EXPECT_FALSE(candidates[0].is_cut_off);
}

TEST(CandidatesOfSets, KnowWhatHidesThem) {
  PaintedScene scene;
  scene.paint(7, {40, 40, 40, 40}, [](int, int) { return 1.4F; });
  scene.paint(8, {70, 30, 30, 60}, [](int, int) { return 1.0F; });
  const std::vector<RegionSet> sets{{RegionId{7}}};
  const std::vector<Candidate> candidates = candidatesOf(sets, scene.input(), 100);
  ASSERT_EQ(candidates.size(), 1U);
  // The right one of four sides: 40 of 30 + 40 + 30 + 40 steps.
  EXPECT_NEAR(candidates[0].hidden, 40 / 140.0, 0.08);
}

TEST(CandidatesOfSets, AreCutOff_AtTheImageBorder) {
  PaintedScene scene;
  scene.paintBump(7, {0, 40, 30, 30}, 1.2F);
  const std::vector<RegionSet> sets{{RegionId{7}}};
  const std::vector<Candidate> candidates = candidatesOf(sets, scene.input(), 100);
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_TRUE(candidates[0].is_cut_off);
}

}  // namespace
}  // namespace scantrove
