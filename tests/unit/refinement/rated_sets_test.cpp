#include "core/refinement/rated_sets.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

const RegionId kShade{1}, kPole{2}, kBox{3};

Candidate looked(const RegionSet& regions, float objectness) {
  Candidate candidate;
  candidate.regions = regions;
  candidate.objectness = objectness;
  return candidate;
}

TEST(RatedSets, TheBestEightCountTogetherWithOneThatSaysNothing) {
  RatedSets looks;
  looks.add(10, std::vector{looked({kBox}, 1)});
  EXPECT_FLOAT_EQ(looks.disjoint(0).at(0).objectness, 0.5F);
  looks.add(20, std::vector{looked({kBox}, 3)});
  looks.add(30, std::vector{looked({kBox}, 2)});
  looks.add(40, std::vector{looked({kBox}, -1)});
  looks.add(50, std::vector{looked({kBox}, 0.5F)});
  for (int frame = 60; frame < 100; frame += 10) looks.add(frame, std::vector{looked({kBox}, -0.5F)});
  const auto best = looks.disjoint(0);
  ASSERT_EQ(best.size(), 1U);
  EXPECT_EQ(best[0].regions, RegionSet{kBox});
  EXPECT_FLOAT_EQ(best[0].objectness, (3 + 2 + 1 + 0.5F - 4 * 0.5F) / 9.0F) << "the one of -1 is the ninth";
  EXPECT_EQ(best[0].frame_index, 20);
}

TEST(RatedSets, WhatIsLargeIsLessLikelyThanItsLooksSay) {
  Candidate small = looked({kBox}, 2), large = looked({kShade, kPole}, 2.2F), upper = looked({kShade}, 2);
  small.size_m = upper.size_m = {0.3F, 0.2F, 0.2F};
  large.size_m = {0.6F, 0.2F, 0.2F};
  RatedSets looks;
  looks.add(1, std::vector{small, large, upper, looked({kPole}, -2)});
  const auto best = looks.disjoint(0);
  ASSERT_EQ(best.size(), 2U) << "of the lamp the upper part only";
  EXPECT_FLOAT_EQ(best[0].objectness, 1);
  EXPECT_FLOAT_EQ(best[1].objectness, 1);
  EXPECT_TRUE(looks.isUnlikely(kPole, 0)) << "1.1 - 2 ln 2";
  EXPECT_FALSE(looks.isUnlikely(kPole, -0.3F));
}

TEST(RatedSets, ALookThatShowsAThingEntirelyIsBetterThanALikelierOneThatDoesNot) {
  Candidate cut_off = looked({kBox}, 3);
  cut_off.is_cut_off = true;
  RatedSets looks;
  looks.add(10, std::vector{cut_off});
  EXPECT_EQ(looks.disjoint(0).at(0).frame_index, 10) << "there is no other yet";
  looks.add(20, std::vector{looked({kBox}, 1)});
  looks.add(30, std::vector{cut_off});
  looks.add(40, std::vector{looked({kBox}, 0.5F)});
  EXPECT_EQ(looks.disjoint(0).at(0).frame_index, 20);
  EXPECT_FLOAT_EQ(looks.disjoint(0).at(0).objectness, (3 + 3 + 1 + 0.5F) / 5)
      << "what is likely is up to all";
}

TEST(RatedSets, OfSetsThatShareRegionsTheMostLikelyStays) {
  RatedSets looks;
  looks.add(1, std::vector{looked({kShade}, 3), looked({kPole}, 1), looked({kBox}, 2)});
  looks.add(1, std::vector{looked({kShade, kPole}, 4), looked({kPole, kBox}, 2.4F)});
  const auto best = looks.disjoint(0.7F);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].regions, (RegionSet{kShade, kPole}));
  EXPECT_EQ(best[1].regions, RegionSet{kBox});
}

TEST(RatedSets, UnlikelyIsWhatWasJudgedAndIsNoPartOfAnythingLikely) {
  RatedSets looks;
  looks.add(1, std::vector{looked({kShade}, -2), looked({kShade, kPole}, 2), looked({kPole}, -2),
                           looked({kBox}, -2)});
  EXPECT_TRUE(looks.isUnlikely(kBox, 0));
  EXPECT_FALSE(looks.isUnlikely(kShade, 0)) << "a part of the lamp";
  EXPECT_TRUE(looks.isUnlikely(kShade, 1.5F));
  EXPECT_FALSE(looks.isUnlikely(RegionId{99}, 0)) << "nothing was said of it";
}

TEST(RatedSets, WhatWasNotJudgedSaysNothing) {
  Candidate while_it_ran;
  while_it_ran.regions = {kBox};
  RatedSets looks;
  looks.add(1, std::vector{while_it_ran});
  EXPECT_TRUE(looks.disjoint(-100).empty());
}

TEST(RatedSets, WhatIsCalledOtherwiseKeepsItsLooks) {
  RatedSets looks;
  looks.add(7, std::vector{looked({kShade}, 4), looked({kShade, kPole}, 1), looked({kPole}, 3)});
  const RegionId upper{11};
  looks.rename([&](const RegionSet& regions) -> std::optional<RegionSet> {
    if (regions == RegionSet{kPole}) return std::nullopt;
    return regions.size() == 1 ? RegionSet{upper} : RegionSet{kBox};
  });
  const auto best = looks.disjoint(0);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].regions, RegionSet{upper});
  EXPECT_FLOAT_EQ(best[0].objectness, 2);
  EXPECT_EQ(best[0].frame_index, 7);
  EXPECT_EQ(best[1].regions, RegionSet{kBox});
  EXPECT_FALSE(looks.isUnlikely(kPole, 0)) << "nothing is known of it any more";
}

}  // namespace
}  // namespace scantrove
