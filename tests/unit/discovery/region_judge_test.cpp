#include "core/discovery/region_judge.h"

#include <gmock/gmock.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

const RegionId kObject{7};

/// Known points: those the scene shows, moved by `aside` in the camera's frame.
void addKnown(const PaintedScene& scene, RegionSamples& known,
              const Eigen::Vector3d& aside = Eigen::Vector3d::Zero()) {
  const DiscoveryInput input = scene.input();
  const Eigen::Vector3f moved = (scene.view.T_world_camera.linear() * aside).cast<float>();
  for (std::size_t i = 0; i < scene.view.vertices_world.size(); ++i) {
    const RegionId region = scene.view.regions[i];
    if (region != RegionId{1})
      known.add(region, input.view.vertices_world[i].head<3>() + moved,
                input.view.normals_world[i].head<3>());
  }
}

std::vector<RegionJudge::Judged> judge(const PaintedScene& scene, RegionSamples known) {
  return RegionJudge(DiscoveryParams{}, std::move(known)).judge(scene.input());
}
std::vector<RegionJudge::Judged> judge(const PaintedScene& scene) {
  RegionSamples known;
  addKnown(scene, known);
  return judge(scene, std::move(known));
}

TEST(RegionJudge, MeasuresTheEvidenceOfAnObject) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  const auto judged = judge(scene);
  ASSERT_EQ(judged.size(), 1U) << "the wall is too large and has no known points";
  EXPECT_EQ(judged[0].hypothesis.regions, RegionSet{kObject});
  const ObjectnessEvidence& evidence = judged[0].evidence;
  EXPECT_FLOAT_EQ(evidence.pixels, 4 * 40 * 30) << "scaled to an image twice as wide and high";
  EXPECT_FLOAT_EQ(evidence.open, 1) << "the wall lies a metre behind it";
  EXPECT_FLOAT_EQ(evidence.fill, 1);
  EXPECT_GT(evidence.bulge, 0.3F);
  EXPECT_NEAR(evidence.known_size_m[0], 0.26F, 0.04F);
  EXPECT_EQ(evidence.largest_part, 1);
}

TEST(RegionJudge, ObjectHasHigherObjectnessThanAPatchOfTheWall) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  scene.paint(8, {10, 20, 30, 60}, [](int, int) { return 2.0F; });
  RegionSamples known;
  addKnown(scene, known);
  const std::vector<Candidate> found = RegionJudge(DiscoveryParams{}, std::move(known)).find(scene.input());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_GT(*found[0].objectness, 0.7F);
  EXPECT_LT(*found[1].objectness, 0);
  EXPECT_EQ(found[0].box_px, cv::Rect(60, 50, 40, 30));
}

TEST(RegionJudge, SkipsRegionsLargerThanObjects) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);  // about 0.25 m
  RegionSamples known;
  addKnown(scene, known);
  DiscoveryParams params;
  params.max_size_m = 0.26F;
  EXPECT_EQ(RegionJudge(params, known).judge(scene.input()).size(), 1U);
  params.max_size_m = 0.15F;
  EXPECT_TRUE(RegionJudge(params, known).judge(scene.input()).empty());
}

TEST(RegionJudge, SkipsSets_WhenNotAskedFor) {
  PaintedScene scene;
  scene.paintBump(7, {20, 50, 40, 30}, 1.0F);
  scene.paintBump(8, {100, 50, 40, 30}, 1.0F);
  RegionSamples known;
  addKnown(scene, known);
  RegionJudge judge(DiscoveryParams{}, std::move(known));
  const std::vector<Candidate> all = judge.find(scene.input());
  ASSERT_EQ(all.size(), 2U);
  judge.askOnlyOf([](const RegionSet& regions) { return regions.contains(RegionId{8}); });
  const std::vector<Candidate> asked = judge.find(scene.input());
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].regions, RegionSet{RegionId{8}});
  EXPECT_EQ(asked[0].objectness, all[1].objectness) << "the same as when all are requested";
}

TEST(RegionJudge, SkipsRegions_WhenMostKnownPointsAreOutOfView) {
  PaintedScene scene;
  scene.paintBump(7, {0, 50, 40, 30}, 1.0F);
  EXPECT_EQ(judge(scene).size(), 1U) << "a quarter of its outline is cut, and no known points lie outside";
  RegionSamples known;
  addKnown(scene, known);
  addKnown(scene, known, {-0.3, 0, 0});
  addKnown(scene, known, {-0.35, 0, 0});
  EXPECT_TRUE(judge(scene, std::move(known)).empty()) << "twice as many known points lie outside as inside";
}

TEST(RegionJudge, SkipsRegions_WhenMostOfTheOutlineIsCut) {
  PaintedScene scene;
  scene.paintBump(7, {0, 0, 30, 120}, 0.7F);
  EXPECT_TRUE(judge(scene).empty());
}

TEST(RegionJudge, IsCutOff_WhenAThirdOfTheKnownPointsIsOutOfView) {
  PaintedScene scene;
  scene.paintBump(7, {0, 50, 40, 30}, 1.0F);
  RegionSamples known, more;
  addKnown(scene, known);
  addKnown(scene, more);
  addKnown(scene, more, {-0.15, 0, 0});
  const auto found = [&scene](RegionSamples of) {
    return RegionJudge(DiscoveryParams{}, std::move(of)).find(scene.input()).at(0);
  };
  EXPECT_FALSE(found(known).is_cut_off);
  EXPECT_TRUE(found(more).is_cut_off) << "a third of its known points lie outside";
  EXPECT_NEAR(found(more).size_m[0], found(known).size_m[0] + 0.15F, 0.04F)
      << "the size of the complete object, not of the visible part";
}

TEST(RegionJudge, IsCutOff_WhenTheImageCutsAThirdOfTheOutline) {
  PaintedScene scene;
  scene.paintBump(7, {0, 30, 20, 60}, 1.0F);
  RegionSamples known;
  addKnown(scene, known);
  EXPECT_NEAR(judge(scene, known).at(0).evidence.cut, 60.0F / 160, 0.02F);
  EXPECT_TRUE(RegionJudge(DiscoveryParams{}, std::move(known)).find(scene.input()).at(0).is_cut_off);
}

TEST(RegionJudge, JudgesSetsOfRegions_WhenTheyMayBeOneObject) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 20, 30}, 1.0F, 0.2F);
  scene.paintBump(8, {80, 50, 20, 30}, 1.0F, 0.2F);
  scene.joining_odds = [](RegionId, RegionId) { return -0.5F; };
  const auto judged = judge(scene);
  ASSERT_EQ(judged.size(), 3U);
  const auto both = std::ranges::find_if(
      judged, [](const RegionJudge::Judged& one) { return one.hypothesis.regions.size() == 2; });
  ASSERT_NE(both, judged.end());
  EXPECT_FLOAT_EQ(both->evidence.odds, -0.5F);
  EXPECT_FLOAT_EQ(both->evidence.largest_part, 0.5F);
}

}  // namespace
}  // namespace scantrove
