// Sets of regions as candidates, concave ones among them, and the choice between candidates.
#include "core/discovery/region_hypotheses.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/discovery/region_points.h"
#include "core/discovery/rule_based_finder.h"
#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;
using testing::ElementsAre;

/// The regions of each candidate of the last of five equal frames.
std::vector<RegionSet> setsIn(const PaintedScene& scene) {
  DiscoveryParams params;
  params.persistent_frames = 5;
  params.min_points = 1600;  // at 640x480; 100 at 160x120
  const auto finder = makeRuleBasedFinder(params);
  std::vector<Candidate> found;
  for (int i = 0; i < 5; ++i) found = finder->find(scene.input());
  std::vector<RegionSet> of_found;
  for (const Candidate& candidate : found) of_found.push_back(candidate.regions);
  return of_found;
}

TEST(RegionPoints, BulgeIsPositiveForABallZeroForAPlaneNegativeForADent) {
  PaintedScene scene;
  const RegionId ball{7}, dent{8}, plane{9};
  const auto paintBall = [&](RegionId region, int center_u, float side) {
    const Eigen::Vector3f middle = scene.view.K.backProject(static_cast<float>(center_u), 59.5F, 1.5F);
    constexpr float kRadius_m = 0.15F;
    for (int v = 0; v < scene.view.K.height; ++v) {
      for (int u = 0; u < scene.view.K.width; ++u) {
        const Eigen::Vector3f ray = scene.view.K.backProject(static_cast<float>(u), static_cast<float>(v), 1);
        // |z ray - center| = r: the near side is convex, the far side concave.
        const float a = ray.squaredNorm(), b = ray.dot(middle),
                    c = middle.squaredNorm() - kRadius_m * kRadius_m;
        if (b * b < a * c) continue;
        const float z = (b + side * std::sqrt(b * b - a * c)) / a;
        scene.paint(region.value, {u, v, 1, 1}, [z](int, int) { return z; });
      }
    }
  };
  paintBall(ball, 40, -1);
  paintBall(dent, 120, 1);
  scene.paint(plane.value, {70, 40, 20, 30}, [](int, int) { return 1.0F; });
  const DiscoveryInput input = scene.input();
  const cv::Rect all(0, 0, scene.view.K.width, scene.view.K.height);
  // For half a ball seen from afar, (p - c) . n is r (1 - 2/3 cos) and |p - c| is r sqrt(13/9 - 4/3 cos),
  // with the angle to the line of sight; their means over the disc are 5/9 and 0.71. From nearby, less of it
  // is visible.
  EXPECT_NEAR(bulgeOf({ball}, all, input), 0.78F, 0.07F);
  EXPECT_NEAR(bulgeOf({dent}, all, input), -0.78F, 0.07F);
  EXPECT_NEAR(bulgeOf({plane}, all, input), 0, 1e-3F);
  EXPECT_EQ(bulgeOf({RegionId{99}}, all, input), 0);
}

TEST(RuleBasedFinder, ProposesNeighborsTogether_WhenCloseToJoining) {
  PaintedScene scene;
  scene.paintBump(7, {60, 50, 20, 30}, 1.0F);
  scene.paintBump(9, {80, 50, 20, 30}, 1.0F);
  const RegionSet one{RegionId{7}}, other{RegionId{9}}, both{RegionId{7}, RegionId{9}};
  EXPECT_THAT(setsIn(scene), ElementsAre(one, other)) << "their joining odds are unknown";
  scene.joining_odds = [](RegionId, RegionId) { return -0.6F; };
  EXPECT_THAT(setsIn(scene), ElementsAre(one, both, other));
  scene.joining_odds = [](RegionId, RegionId) { return -kNearOdds - 1; };
  EXPECT_THAT(setsIn(scene), ElementsAre(one, other)) << "clearly two objects";
}

TEST(RuleBasedFinder, ProposesABowlsInsideOnlyWithItsOutside) {
  // A bowl from above: its front wall occludes the near side of its inside.
  PaintedScene scene;
  const RegionId inside{8}, outside{7};
  scene.paintBowl(inside.value, {60, 40, 40, 20}, 1.08F);
  scene.paintBump(outside.value, {60, 60, 40, 20}, 1.0F, 0.5F);
  EXPECT_THAT(setsIn(scene), ElementsAre(RegionSet{outside}, RegionSet{inside}))
      << "their joining odds are unknown";
  scene.joining_odds = [](RegionId, RegionId) { return -0.5F; };
  EXPECT_THAT(setsIn(scene), ElementsAre(RegionSet{outside, inside}));
  // A block behind a wall that occludes as much of it is a separate object.
  scene.paintBump(inside.value, {60, 40, 40, 20}, 1.2F, 0.5F);
  EXPECT_THAT(setsIn(scene), ElementsAre(RegionSet{outside}, RegionSet{inside}));
}

TEST(RuleBasedFinder, ObjectInAPlateIsNotItsOutside) {
  PaintedScene scene;
  const RegionId can{7}, plate{8};
  scene.paintBowl(plate.value, {50, 50, 60, 30}, 1.08F);
  scene.paintBump(can.value, {68, 40, 24, 26}, 1.0F, 0.5F);
  scene.joining_odds = [](RegionId, RegionId) { return -1.5F; };
  const DiscoveryInput input = scene.input();
  ASSERT_LT(bulgeOf({plate}, {50, 50, 60, 30}, input), -0.03F) << "the plate is concave";
  const DiscoveryParams params;
  const RegionOutlines outlines(input);
  std::vector<RegionExtent> regions = RegionCounter().count(scene.view.regions, scene.view.K.width).extents;
  std::erase_if(regions, [](const RegionExtent& extent) { return extent.region == RegionId{1}; });
  const std::vector<RegionHypothesis> hypotheses = proposeHypotheses(regions, outlines, input, params);
  ASSERT_GE(hypotheses.size(), 2U) << "each alone";
  for (const RegionHypothesis& hypothesis : hypotheses) EXPECT_FALSE(hypothesis.is_inconsistent);
}

TEST(Candidate, ClearObjectMayBeHiddenMore) {
  Candidate candidate;
  candidate.outline = 0.95F;
  candidate.bulge = 0.3F;
  EXPECT_GT(candidate.mostHidden(0.3F), 0.4F);
  candidate.bulge = 0.05F;  // a book, or a patch of the table
  EXPECT_EQ(candidate.mostHidden(0.3F), 0.3F);
  candidate.bulge = 0.3F;
  candidate.outline = 0.85F;
  EXPECT_EQ(candidate.mostHidden(0.3F), 0.3F);
}

TEST(ChooseDisjoint, KeepsTheBest_WhenCandidatesShareRegions) {
  const auto candidateOf = [](const RegionSet& regions, float outline, bool is_complete, float odds = 0) {
    Candidate candidate;
    candidate.regions = regions;
    candidate.outline = outline;
    candidate.is_complete = is_complete;
    candidate.odds = odds;
    return candidate;
  };
  const RegionId a{1}, b{2}, c{3};
  const std::vector<float> nothing(3, 0.0F);
  // Front and top of one box, complete together.
  EXPECT_THAT(chooseDisjoint(std::vector{candidateOf({a}, 0.6F, false), candidateOf({a, b}, 0.95F, true, -1),
                                         candidateOf({b}, 0.6F, false)},
                             nothing),
              ElementsAre(1U));
  // Two objects that touch.
  EXPECT_THAT(chooseDisjoint(std::vector{candidateOf({a}, 0.9F, true), candidateOf({a, b}, 0.9F, true, -3),
                                         candidateOf({b}, 0.9F, true)},
                             nothing),
              ElementsAre(0U, 2U));
  // Objects of the catalogue come first.
  EXPECT_THAT(chooseDisjoint(std::vector{candidateOf({a}, 0.9F, true), candidateOf({a, b}, 0.8F, true, -3),
                                         candidateOf({c}, 0.5F, false)},
                             std::vector{0.0F, 1.0F, 0.0F}),
              ElementsAre(1U, 2U));
}

}  // namespace
}  // namespace scantrove
