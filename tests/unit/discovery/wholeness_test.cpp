#include "core/discovery/wholeness.h"

#include <gmock/gmock.h>

#include <cmath>

namespace scantrove {
namespace {

/// A mug on a table, seen from nearby.
WholenessEvidence mug() {
  WholenessEvidence evidence;
  evidence.pixels = 1500;
  evidence.open = 0.75F;
  evidence.folded = 0.2F;
  evidence.fill = 0.75F;
  evidence.convexity = 0.95F;
  evidence.relief_m = 0.1F;
  evidence.area_m2 = 0.009F;
  evidence.bulge = 0.5F;
  evidence.known_bulge = 0.45F;
  evidence.known_flatness = 0.5F;
  evidence.known_size_m = {0.13F, 0.1F, 0.09F};
  evidence.bounds = {.mean = 0.98F, .least_side = 0.95F};
  return evidence;
}

TEST(Wholeness, WeighsSizesAsTheirShape) {
  WholenessEvidence evidence = mug();
  evidence.largest_part = 0.8F;
  evidence.odds = -1.5F;
  const auto x = evidence.features();
  EXPECT_FLOAT_EQ(x[0], std::log(1500.0F));
  EXPECT_FLOAT_EQ(x[6], std::log(0.13F));
  EXPECT_FLOAT_EQ(x[7], 0.1F / 0.13F);
  EXPECT_FLOAT_EQ(x[8], 0.09F / 0.13F);
  EXPECT_FLOAT_EQ(x[13], -1.5F);
  EXPECT_FLOAT_EQ(mug().features()[13], 4) << "one region holds together";
}

TEST(Wholeness, HearsColoursAndWithoutThemTakesThemForUsual) {
  WholenessEvidence evidence = mug();
  evidence.likeness =
      ColorLikeness{.neighbour = 0.9F, .touching = 0.8F, .end_to_end = 0.7F, .side_to_side = 0.6F};
  EXPECT_EQ(evidence.features()[14], 0.9F);
  EXPECT_EQ(evidence.features()[15], 0.8F);
  EXPECT_EQ(evidence.features()[22], 0.7F);
  EXPECT_EQ(evidence.features()[23], 0.6F);
  const float like_all_around = evidence.logOdds();
  evidence.likeness =
      ColorLikeness{.neighbour = 0.1F, .touching = 0.05F, .end_to_end = 0.7F, .side_to_side = 0.6F};
  const float unlike = evidence.logOdds();
  EXPECT_GT(unlike, like_all_around);
  const auto usual = mug().features();
  EXPECT_GT(usual[14], 0.1F);
  EXPECT_LT(usual[14], 0.9F);
  EXPECT_GT(usual[15], 0.05F);
  EXPECT_LT(usual[15], 0.8F);
}

TEST(Wholeness, HearsWhereColoursChangeAndWithoutThemTakesThatForUsual) {
  WholenessEvidence evidence = mug();
  evidence.changes = ColorChanges{.along = {.contrast = 0.9F, .likeness = 0.1F},
                                  .across = {.contrast = 0.8F, .likeness = 0.2F}};
  const auto x = evidence.features();
  EXPECT_EQ(x[28], 0.9F);
  EXPECT_EQ(x[29], 0.8F);
  EXPECT_EQ(x[30], 0.1F);
  EXPECT_EQ(x[31], 0.2F);
  const auto usual = mug().features();
  for (const std::size_t i : {28, 29, 30, 31}) {
    EXPECT_GT(usual[i], 0.2F);
    EXPECT_LT(usual[i], 0.9F);
  }
}

TEST(Wholeness, HearsHowWellItsOutlineIsBounded) {
  WholenessEvidence evidence = mug();
  evidence.bounds = {.mean = 0.9F, .least_side = 0.7F};
  EXPECT_EQ(evidence.features()[26], 0.9F);
  EXPECT_EQ(evidence.features()[27], 0.7F);
}

TEST(Wholeness, ABooksBackWithoutBoundsIsLessLikely) {
  // What bulges and stands free is clear anyway.
  WholenessEvidence evidence = mug();
  evidence.open = 0.15F;
  evidence.hidden = 0.3F;
  evidence.bulge = evidence.known_bulge = 0;
  evidence.known_flatness = 0.06F;
  evidence.known_size_m = {0.2F, 0.05F, 0.02F};
  const float bounded = evidence.logOdds();
  evidence.bounds = {.mean = 0.6F, .least_side = 0.1F};
  EXPECT_LT(evidence.logOdds(), bounded - 0.5F) << "a piece of something";
}

TEST(Wholeness, OddsOfWhatItTouchesCountUpToWhatIsAsGoodAsCertain) {
  WholenessEvidence part = mug();
  EXPECT_EQ(part.features()[19], OutwardOdds::kLeast) << "it touches nothing";
  part.outward_odds = 9;
  EXPECT_FLOAT_EQ(part.features()[19], 4) << "more is as good as certain";
}

TEST(Wholeness, WhatIsNothingYetHasFeaturesToo) {
  for (const float x : WholenessEvidence{}.features()) EXPECT_TRUE(std::isfinite(x));
}

TEST(Wholeness, AThingOnATableIsOneAndAPatchOfTheWallIsNone) {
  EXPECT_GT(mug().logOdds(), 1.5F);
  WholenessEvidence patch = mug();
  patch.open = 0.1F;
  patch.folded = 0.1F;
  patch.hidden = 0.6F;
  patch.bulge = patch.known_bulge = 0;
  patch.known_flatness = 0.02F;
  patch.known_size_m = {0.6F, 0.3F, 0.01F};
  EXPECT_LT(patch.logOdds(), -1.5F);
}

TEST(Wholeness, SeveralRegionsThatHardlyHoldTogetherAreLessLikely) {
  WholenessEvidence set = mug();
  set.largest_part = 0.5F;
  set.odds = -2.9F;
  EXPECT_LT(set.logOdds(), mug().logOdds());
}

}  // namespace
}  // namespace scantrove
