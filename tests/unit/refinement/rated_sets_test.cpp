#include "core/refinement/rated_sets.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

const RegionId kShade{1}, kPole{2}, kBox{3};

Candidate rated(const RegionSet& regions, float objectness) {
  Candidate candidate;
  candidate.regions = regions;
  candidate.objectness = objectness;
  return candidate;
}

TEST(RatedSets, AveragesTheBestEightObservationsAndANeutralOne) {
  RatedSets sets;
  sets.add(10, std::vector{rated({kBox}, 1)});
  EXPECT_FLOAT_EQ(sets.disjoint(0).at(0).objectness, 0.5F);
  sets.add(20, std::vector{rated({kBox}, 3)});
  sets.add(30, std::vector{rated({kBox}, 2)});
  sets.add(40, std::vector{rated({kBox}, -1)});
  sets.add(50, std::vector{rated({kBox}, 0.5F)});
  for (int frame = 60; frame < 100; frame += 10) sets.add(frame, std::vector{rated({kBox}, -0.5F)});
  const auto best = sets.disjoint(0);
  ASSERT_EQ(best.size(), 1U);
  EXPECT_EQ(best[0].regions, RegionSet{kBox});
  EXPECT_FLOAT_EQ(best[0].objectness, (3 + 2 + 1 + 0.5F - 4 * 0.5F) / 9.0F)
      << "the rating of -1 is the ninth";
  EXPECT_EQ(best[0].frame_index, 20);
}

TEST(RatedSets, ReducesObjectness_WhenASetIsLarge) {
  Candidate small = rated({kBox}, 2), large = rated({kShade, kPole}, 2.2F), upper = rated({kShade}, 2);
  small.size_m = upper.size_m = {0.3F, 0.2F, 0.2F};
  large.size_m = {0.6F, 0.2F, 0.2F};
  RatedSets sets;
  sets.add(1, std::vector{small, large, upper, rated({kPole}, -2)});
  const auto best = sets.disjoint(0);
  ASSERT_EQ(best.size(), 2U) << "of the lamp, only the upper part";
  EXPECT_FLOAT_EQ(best[0].objectness, 1);
  EXPECT_FLOAT_EQ(best[1].objectness, 1);
  EXPECT_TRUE(sets.isUnlikely(kPole, 0)) << "1.1 - 2 ln 2";
  EXPECT_FALSE(sets.isUnlikely(kPole, -0.3F));
}

TEST(RatedSets, PrefersACompleteView_OverALikelierCutOffOne) {
  Candidate cut_off = rated({kBox}, 3);
  cut_off.is_cut_off = true;
  RatedSets sets;
  sets.add(10, std::vector{cut_off});
  EXPECT_EQ(sets.disjoint(0).at(0).frame_index, 10) << "the only observation so far";
  sets.add(20, std::vector{rated({kBox}, 1)});
  sets.add(30, std::vector{cut_off});
  sets.add(40, std::vector{rated({kBox}, 0.5F)});
  EXPECT_EQ(sets.disjoint(0).at(0).frame_index, 20);
  EXPECT_FLOAT_EQ(sets.disjoint(0).at(0).objectness, (3 + 3 + 1 + 0.5F) / 5)
      << "all observations count for objectness";
}

TEST(RatedSets, KeepsTheMostLikelySet_WhenSetsShareRegions) {
  RatedSets sets;
  sets.add(1, std::vector{rated({kShade}, 3), rated({kPole}, 1), rated({kBox}, 2)});
  sets.add(1, std::vector{rated({kShade, kPole}, 4), rated({kPole, kBox}, 2.4F)});
  const auto best = sets.disjoint(0.7F);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].regions, (RegionSet{kShade, kPole}));
  EXPECT_EQ(best[1].regions, RegionSet{kBox});
}

TEST(RatedSets, RegionIsUnlikely_WhenNoLikelySetContainsIt) {
  RatedSets sets;
  sets.add(
      1, std::vector{rated({kShade}, -2), rated({kShade, kPole}, 2), rated({kPole}, -2), rated({kBox}, -2)});
  EXPECT_TRUE(sets.isUnlikely(kBox, 0));
  EXPECT_FALSE(sets.isUnlikely(kShade, 0)) << "a part of the lamp";
  EXPECT_TRUE(sets.isUnlikely(kShade, 1.5F));
  EXPECT_FALSE(sets.isUnlikely(RegionId{99}, 0)) << "it was never rated";
}

TEST(RatedSets, RegionsHaveTheObjectnessOfTheirCompleteSet_ElseTheirOwn) {
  RatedSets sets;
  sets.add(1,
           std::vector{rated({kShade}, -2), rated({kPole}, 1), rated({kShade, kPole}, 4), rated({kBox}, -3)});
  const auto complete = sets.disjoint(0);
  ASSERT_EQ(complete.size(), 1U);
  // One observation counts half.
  EXPECT_THAT(sets.ofRegions(complete),
              testing::ElementsAre(std::pair(kShade, 2.0F), std::pair(kPole, 2.0F), std::pair(kBox, -1.5F)));
  EXPECT_THAT(sets.ofRegions({}),
              testing::ElementsAre(std::pair(kShade, -1.0F), std::pair(kPole, 0.5F), std::pair(kBox, -1.5F)));
}

TEST(RatedSets, RegionHasNoObjectness_WhenOnlySetsWithItWereRated) {
  RatedSets sets;
  sets.add(1, std::vector{rated({kShade, kPole}, -4)});
  EXPECT_TRUE(sets.ofRegions(sets.disjoint(0)).empty());
}

TEST(RatedSets, IgnoresACandidate_WithoutObjectness) {
  Candidate unrated;
  unrated.regions = {kBox};
  RatedSets sets;
  sets.add(1, std::vector{unrated});
  EXPECT_TRUE(sets.disjoint(-100).empty());
}

TEST(RatedSets, KeepsObservations_WhenSetsAreRenamed) {
  RatedSets sets;
  sets.add(7, std::vector{rated({kShade}, 4), rated({kShade, kPole}, 1), rated({kPole}, 3)});
  const RegionId upper{11};
  sets.rename([&](const RegionSet& regions) -> std::optional<RegionSet> {
    if (regions == RegionSet{kPole}) return std::nullopt;
    return regions.size() == 1 ? RegionSet{upper} : RegionSet{kBox};
  });
  const auto best = sets.disjoint(0);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].regions, RegionSet{upper});
  EXPECT_FLOAT_EQ(best[0].objectness, 2);
  EXPECT_EQ(best[0].frame_index, 7);
  EXPECT_EQ(best[1].regions, RegionSet{kBox});
  EXPECT_FALSE(sets.isUnlikely(kPole, 0)) << "its observations were dropped";
}

}  // namespace
}  // namespace scantrove
