#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/discovery/region_outlines.h"
#include "core/discovery/region_points.h"
#include "core/discovery/region_rules.h"
#include "core/discovery/rule_based_finder.h"
#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;
using testing::ElementsAre;
using testing::IsEmpty;

DiscoveryParams testParams() {
  DiscoveryParams params;
  params.persistent_frames = 5;
  params.min_points = 1600;  // at 640x480; 100 at 160x120
  params.central_fraction = 0.8F;
  return params;
}

std::vector<std::uint32_t> idsOf(const std::vector<Candidate>& candidates) {
  std::vector<std::uint32_t> ids;
  for (const Candidate& candidate : candidates) ids.push_back(candidate.regions.begin()->value);
  return ids;
}

/// Ids of the last of `frames` equal frames.
std::vector<std::uint32_t> findAfter(const PaintedScene& scene, const DiscoveryParams& params, int frames) {
  const auto finder = makeRuleBasedFinder(params);
  std::vector<std::uint32_t> ids;
  for (int i = 0; i < frames; ++i) ids = idsOf(finder->find(scene.input()));
  return ids;
}

/// The rules that region `id` breaks after enough frames.
std::vector<std::string> broken(const PaintedScene& scene, const DiscoveryParams& params, std::uint32_t id) {
  RegionCounter counter;
  const RegionCensus census = counter.count(scene.view.regions, scene.view.K.width);
  const auto extent =
      std::ranges::find_if(census.extents, [&](const auto& e) { return e.region.value == id; });
  if (extent == census.extents.end()) return {"there is no such region"};
  const DiscoveryInput input = scene.input();
  const OrientedBox box = fitOrientedBox(pointsOf({extent->region}, extent->box_px, input));
  const cv::Rect visible = visibleFrame(census, scene.view.K.width, scene.view.K.height, params);
  std::vector<std::string> rules;
  const auto ask = [&](const char* rule, bool holds) {
    if (!holds) rules.emplace_back(rule);
  };
  ask("off border", isOffBorder(*extent, visible, params));
  ask("enough points", hasEnoughPoints(*extent, scene.view.K, params));
  ask("central", isCentral(*extent, scene.view.K, params));
  ask("not eccentric", !isEccentric(*extent, params));
  ask("size in range", isSizeInRange(box, params));
  ask("not flat", !isFlat(box, bulgeOf({extent->region}, extent->box_px, input), params));
  ask("not a strip", !isStrip(box, bulgeOf({extent->region}, extent->box_px, input), params));
  ask("not background", !isBackground(RegionOutlines(input).of({extent->region}), params));
  return rules;
}

TEST(RuleBasedFinder, FindsAnObjectWithItsBoxMaskAndPlace) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  scene.view.regions[50 * 160 + 60] = RegionId{1};  // a corner that belongs to the wall
  const auto finder = makeRuleBasedFinder(testParams());
  std::vector<Candidate> found;
  for (int i = 0; i < 5; ++i) found = finder->find(scene.input());
  ASSERT_EQ(found.size(), 1U);
  const Candidate& candidate = found[0];
  EXPECT_EQ(candidate.regions.begin()->value, 7U);
  EXPECT_EQ(candidate.box_px, cv::Rect(60, 50, 40, 30));
  EXPECT_EQ(candidate.pixels, 40 * 30 - 1);
  EXPECT_EQ(cv::countNonZero(candidate.mask), 40 * 30 - 1);
  EXPECT_EQ(candidate.mask.at<unsigned char>(0, 0), 0);
  // 40 pixels at about 1 m and f = 150 are 0.27 m; the bulge's rim lies at 1 m, its front nearer.
  EXPECT_NEAR(candidate.size_m[0], 0.26F, 0.04F);
  EXPECT_GE(candidate.size_m[0], candidate.size_m[1]);
  EXPECT_GE(candidate.size_m[1], candidate.size_m[2]);
  EXPECT_NEAR(candidate.centroid_camera.z(), 0.9F, 0.05F);
  const Eigen::Vector3f back =
      (scene.view.T_world_camera * candidate.centroid_camera.cast<double>()).cast<float>();
  EXPECT_LT((back - candidate.centroid_world).norm(), 1e-5F);
}

TEST(RuleBasedFinder, ListsCandidatesByRegion) {
  PaintedScene scene;
  scene.paintBump(900, {40, 50, 20, 20}, 1.0F);
  scene.paintBump(12, {90, 30, 20, 20}, 1.2F);
  EXPECT_THAT(findAfter(scene, testParams(), 5), ElementsAre(12U, 900U));
}

TEST(RuleBasedFinder, NeedsPersistence) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  EXPECT_THAT(findAfter(scene, testParams(), 4), IsEmpty());
  EXPECT_THAT(findAfter(scene, testParams(), 5), ElementsAre(7U));
  EXPECT_THAT(broken(scene, testParams(), 7), IsEmpty()) << "it breaks no other rule";
}

TEST(RuleBasedFinder, ResetsPersistence_AfterAGapOrAChangeOfSize) {
  PaintedScene with, without, larger;
  with.paintBump(7, {60, 50, 40, 30}, 1.0F);
  larger.paintBump(7, {50, 40, 60, 50}, 1.0F);
  const auto finder = makeRuleBasedFinder(testParams());
  const auto see = [&](const PaintedScene& scene) { return idsOf(finder->find(scene.input())); };
  for (int i = 0; i < 4; ++i) EXPECT_THAT(see(with), IsEmpty());
  EXPECT_THAT(see(without), IsEmpty());
  for (int i = 0; i < 4; ++i) EXPECT_THAT(see(with), IsEmpty());
  EXPECT_THAT(see(with), ElementsAre(7U));
  for (int i = 0; i < 4; ++i) EXPECT_THAT(see(larger), IsEmpty());
  EXPECT_THAT(see(larger), ElementsAre(7U));
}

TEST(RuleBasedFinder, KeepsPersistence_WhenTheCameraApproaches) {
  // The camera approaches: the same 0.2 m plate fills ever more pixels.
  const auto finder = makeRuleBasedFinder(testParams());
  std::vector<std::uint32_t> ids;
  for (int i = 0; i < 6; ++i) {
    PaintedScene scene;
    const float z = 1.6F - 0.18F * static_cast<float>(i);
    const int side = static_cast<int>(std::lround(0.2F * scene.view.K.fx / z));
    scene.paint(7, {80 - side / 2, 60 - side / 2, side, side}, [z](int, int) { return z; });
    ids = idsOf(finder->find(scene.input()));
  }
  EXPECT_THAT(ids, ElementsAre(7U));
}

TEST(RuleBasedFinder, RejectsRegions_WhenTheyTouchTheBorder) {
  for (const cv::Rect& box : {cv::Rect(0, 45, 40, 30), cv::Rect(60, 0, 30, 40), cv::Rect(1, 45, 40, 30)}) {
    PaintedScene scene;
    scene.paintBump(7, box, 1.0F);
    DiscoveryParams params = testParams();
    params.central_fraction = 1;
    EXPECT_THAT(findAfter(scene, params, 6), IsEmpty()) << box;
    EXPECT_THAT(broken(scene, params, 7), ElementsAre("off border")) << box;
  }
}

TEST(RuleBasedFinder, RejectsRegions_WhenTheyTouchAnUnlabeledStripAtTheEdge) {
  // A Kinect's depth lacks the last columns, so regions that end there are cut off.
  PaintedScene scene;
  scene.paintBump(7, {115, 45, 40, 30}, 1.0F);
  DiscoveryParams params = testParams();
  params.central_fraction = 1;
  EXPECT_THAT(findAfter(scene, params, 5), ElementsAre(7U));
  for (int v = 0; v < 120; ++v) {
    for (int u = 155; u < 160; ++u) scene.view.regions[static_cast<std::size_t>(v * 160 + u)] = RegionId{};
  }
  EXPECT_THAT(findAfter(scene, params, 5), IsEmpty());
  EXPECT_THAT(broken(scene, params, 7), ElementsAre("off border"));
}

TEST(RuleBasedFinder, FindsAnObject_WhenItIsAloneInTheView) {
  PaintedScene scene;
  std::ranges::fill(scene.view.regions, RegionId{});
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  EXPECT_THAT(findAfter(scene, testParams(), 5), ElementsAre(7U));
}

TEST(RuleBasedFinder, RejectsRegions_WithFewPoints) {
  PaintedScene scene;
  scene.paintBump(7, {70, 50, 11, 9}, 1.0F);  // 99 < 100
  EXPECT_THAT(findAfter(scene, testParams(), 6), IsEmpty());
  EXPECT_THAT(broken(scene, testParams(), 7), ElementsAre("enough points"));
  scene.paintBump(7, {70, 50, 11, 10}, 1.0F);
  EXPECT_THAT(findAfter(scene, testParams(), 6), ElementsAre(7U));
}

TEST(RuleBasedFinder, RejectsRegions_WhenNotCentral) {
  PaintedScene scene;
  scene.paintBump(7, {4, 50, 20, 20}, 1.0F);  // centroid at u = 13.5, the middle part starts at 15.5
  EXPECT_THAT(findAfter(scene, testParams(), 6), IsEmpty());
  EXPECT_THAT(broken(scene, testParams(), 7), ElementsAre("central"));
}

TEST(RuleBasedFinder, RejectsRegions_WhenTooLargeOrTooSmall) {
  PaintedScene scene;
  scene.paintBump(7, {20, 20, 120, 80}, 1.6F, 0.6F);  // 1.28 m
  EXPECT_THAT(findAfter(scene, testParams(), 6), IsEmpty());
  EXPECT_THAT(broken(scene, testParams(), 7), ElementsAre("size in range"));
  DiscoveryParams params = testParams();
  params.max_size_m = 1.4F;
  EXPECT_THAT(findAfter(scene, params, 6), ElementsAre(7U));
  params.min_size_m = 1.35F;
  EXPECT_THAT(broken(scene, params, 7), ElementsAre("size in range"));
}

TEST(RuleBasedFinder, RejectsLargePlanesAndKeepsBooks) {
  PaintedScene panel;  // 0.53 x 0.4 m
  panel.paint(7, {60, 45, 40, 30}, [](int, int) { return 2.0F; });
  EXPECT_THAT(findAfter(panel, testParams(), 6), IsEmpty());
  EXPECT_THAT(broken(panel, testParams(), 7), ElementsAre("not flat"));
  PaintedScene book;  // 0.27 x 0.2 m, as flat
  book.paint(7, {60, 45, 40, 30}, [](int, int) { return 1.0F; });
  EXPECT_THAT(findAfter(book, testParams(), 6), ElementsAre(7U));
}

TEST(RuleBasedFinder, RejectsLongThinShapes) {
  PaintedScene scene;
  scene.paintBump(7, {40, 50, 80, 10}, 0.8F);  // 8 : 1
  EXPECT_THAT(findAfter(scene, testParams(), 6), IsEmpty());
  EXPECT_THAT(broken(scene, testParams(), 7), ElementsAre("not eccentric"));
}

TEST(RuleBasedFinder, FindsOneObject_WhenAnOccluderDividesIt) {
  // A thin occluder is in front of it.
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  scene.paint(8, {78, 0, 4, 120}, [](int, int) { return 0.6F; });
  const auto finder = makeRuleBasedFinder(testParams());
  std::vector<Candidate> found;
  for (int i = 0; i < 5; ++i) found = finder->find(scene.input());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].box_px, cv::Rect(60, 50, 40, 30));
  EXPECT_EQ(found[0].pixels, 36 * 30);
  EXPECT_EQ(found[0].mask.at<unsigned char>(10, 19), 0);
  EXPECT_EQ(found[0].mask.at<unsigned char>(10, 30), 255);
}

TEST(RuleBasedFinder, SkipsPixelsWithoutSurface) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
  scene.view.vertices_world[60 * 160 + 70] << NAN, NAN, NAN, 1;
  scene.view.vertices_world[60 * 160 + 71].setZero();
  EXPECT_THAT(findAfter(scene, testParams(), 5), ElementsAre(7U));
}

TEST(RuleBasedFinder, KeepsHistory_WhenRegionsJoin) {
  PaintedScene before, after;
  before.paintBump(7, {60, 50, 40, 30}, 1.0F);
  after.paintBump(9, {60, 50, 40, 30}, 1.0F);
  const auto finder = makeRuleBasedFinder(testParams());
  for (int i = 0; i < 4; ++i) EXPECT_THAT(finder->find(before.input()), IsEmpty());
  finder->regionsJoined(RegionId{9}, RegionId{7});
  EXPECT_THAT(idsOf(finder->find(after.input())), ElementsAre(9U));
}

TEST(RuleBasedFinder, RejectsBackgroundSeenThroughAGap) {
  PaintedScene scene;
  scene.paint(2, {0, 0, 160, 120}, [](int, int) { return 0.9F; });  // a screen with a window
  scene.paintBump(7, {60, 45, 40, 30}, 1.3F, 0.2F);
  EXPECT_THAT(findAfter(scene, testParams(), 6), IsEmpty());
  EXPECT_THAT(broken(scene, testParams(), 7), ElementsAre("not background"));
  // A nearer surface only below it: an object behind another.
  scene.paint(2, {0, 0, 160, 45}, [](int, int) { return 1.3F; });
  scene.paint(2, {0, 45, 60, 75}, [](int, int) { return 1.3F; });
  scene.paint(2, {100, 45, 60, 75}, [](int, int) { return 1.3F; });
  EXPECT_THAT(findAfter(scene, testParams(), 6), ElementsAre(7U));
}

TEST(RuleBasedFinder, CandidateIsComplete_WhenSeenFromTwoSidesOrForLong) {
  DiscoveryParams params = testParams();
  params.complete_observations = 3;
  params.still_frames = 20;
  const auto is_complete_after = [&](int frames, double degrees_a_frame) {
    const auto finder = makeRuleBasedFinder(params);
    std::vector<Candidate> found;
    for (int i = 0; i < frames; ++i) {
      PaintedScene scene;
      // The camera moves around the object, which is 1 m ahead.
      const Eigen::Vector3d center = scene.view.T_world_camera * Eigen::Vector3d(0, 0, 1);
      const double radians = degrees_a_frame * i * 3.14159265 / 180;
      scene.view.T_world_camera = Eigen::Translation3d(center) *
                                  Eigen::AngleAxisd(radians, Eigen::Vector3d::UnitY()) *
                                  Eigen::Translation3d(-center) * scene.view.T_world_camera;
      scene.paint(1, {0, 0, 160, 120}, [](int, int) { return 2.0F; });
      scene.paintBump(7, {60, 50, 40, 30}, 1.0F);
      found = finder->find(scene.input());
    }
    return !found.empty() && found[0].is_complete;
  };
  EXPECT_FALSE(is_complete_after(10, 0)) << "from one side";
  EXPECT_TRUE(is_complete_after(26, 0)) << "for many frames";
  EXPECT_TRUE(is_complete_after(10, 2)) << "from two sides";
  EXPECT_FALSE(is_complete_after(6, 10)) << "in too few frames";
}

TEST(RuleBasedFinder, PatchOfALargerPlaneIsNeverComplete) {
  PaintedScene scene;
  scene.paint(7, {60, 50, 40, 30}, [](int, int) { return 2.0F; });  // of the wall
  DiscoveryParams params = testParams();
  params.max_flat_size_m = 1;
  const auto finder = makeRuleBasedFinder(params);
  std::vector<Candidate> found;
  for (int i = 0; i < 60; ++i) found = finder->find(scene.input());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(found[0].outline, 0.05F);
  EXPECT_FALSE(found[0].is_complete);
}

TEST(RuleBasedFinder, EmptyFrameHasNoCandidates) {
  PaintedScene scene;
  std::ranges::fill(scene.view.regions, RegionId{});
  EXPECT_THAT(findAfter(scene, testParams(), 5), IsEmpty());
}

TEST(RuleBasedFinder, CandidateHasAppeared_WhenMostOfItsPixelsHave) {
  PaintedScene scene;
  const cv::Rect box(60, 45, 30, 30);
  scene.paintBump(2, box, 1);
  for (const int rows : {0, 12, 18, 30}) {
    scene.appeared.assign(static_cast<std::size_t>(scene.view.K.pixels()), 0);
    for (int v = box.y; v < box.y + rows; ++v) {
      for (int u = box.x; u < box.br().x; ++u)
        scene.appeared[static_cast<std::size_t>(v * scene.view.K.width + u)] = 3;
    }
    const auto finder = makeRuleBasedFinder(testParams());
    std::vector<Candidate> candidates;
    for (int i = 0; i < 6; ++i) candidates = finder->find(scene.input());
    ASSERT_EQ(idsOf(candidates), std::vector<std::uint32_t>{2});
    EXPECT_EQ(candidates[0].has_appeared, rows > 15) << rows;
  }
}

}  // namespace
}  // namespace scantrove
