#include "core/discovery/outward_odds.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

/// Region 7, of 20 x 20 pixels before a wall far behind; 8 touches all of its right side, 9 half of its left.
PaintedScene threeInARow() {
  PaintedScene scene;
  const auto near = [](int, int) { return 1.0F; };
  scene.paint(7, {60, 40, 20, 20}, near);
  scene.paint(8, {80, 40, 20, 20}, near);
  scene.paint(9, {40, 40, 20, 10}, near);
  return scene;
}

OutwardOdds oddsOf(const PaintedScene& scene, const RegionSet& regions) {
  const DiscoveryInput input = scene.input();
  return outwardOddsOf(regions, RegionOutlines(input), input);
}

TEST(OutwardOdds, IsLeast_WithoutContact) {
  PaintedScene scene;
  scene.paint(7, {60, 40, 20, 20}, [](int, int) { return 1.0F; });
  scene.joining_odds = [](RegionId, RegionId) { return 3.0F; };
  EXPECT_EQ(oddsOf(scene, {RegionId{7}}).most, OutwardOdds::kMin) << "the wall is a metre behind it";
  EXPECT_EQ(oddsOf(scene, {RegionId{7}}).joined_part, 0);
}

TEST(OutwardOdds, MostIsTheLargestOddsOfAContact) {
  PaintedScene scene = threeInARow();
  scene.joining_odds = [](RegionId a, RegionId b) {
    return a == RegionId{8} || b == RegionId{8} ? -1.0F : -2.0F;
  };
  const OutwardOdds odds = oddsOf(scene, {RegionId{7}});
  EXPECT_FLOAT_EQ(odds.most, -1);
  // Of 80 outline steps, 20 touch region 8 and 10 touch region 9; a step at a corner may miss the neighbour.
  const float expected = 20 / 80.0F / (1 + std::exp(1.0F)) + 10 / 80.0F / (1 + std::exp(2.0F));
  EXPECT_NEAR(odds.joined_part, expected, 0.01F);
}

TEST(OutwardOdds, IgnoresContactsInsideTheSet) {
  PaintedScene scene = threeInARow();
  scene.joining_odds = [](RegionId a, RegionId b) {
    return a == RegionId{8} || b == RegionId{8} ? -1.0F : -2.0F;
  };
  EXPECT_FLOAT_EQ(oddsOf(scene, {RegionId{7}, RegionId{8}}).most, -2);
}

TEST(OutwardOdds, IsLeast_WhenNeighborsCannotLink) {
  PaintedScene scene = threeInARow();
  scene.joining_odds = [](RegionId, RegionId) { return -std::numeric_limits<float>::infinity(); };
  const OutwardOdds odds = oddsOf(scene, {RegionId{7}});
  EXPECT_EQ(odds.most, OutwardOdds::kMin);
  EXPECT_LT(odds.joined_part, 1e-3F);
}

}  // namespace
}  // namespace scantrove
