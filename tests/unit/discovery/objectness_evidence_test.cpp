#include "core/discovery/objectness/objectness_evidence.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/discovery/objectness/objectness_features.h"

namespace scantrove {
namespace {

/// A mug on a table, nearby.
ObjectnessEvidence mug() {
  ObjectnessEvidence evidence;
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

float feature(std::string_view name, const ObjectnessEvidence& evidence) {
  const auto of = std::ranges::find(kObjectnessFeatures, name, &Feature<ObjectnessEvidence>::name);
  return of == kObjectnessFeatures.end() ? throw std::out_of_range(std::string(name)) : of->of(evidence);
}

TEST(ObjectnessEvidence, WeighsSizesByTheLongestSide) {
  const ObjectnessEvidence evidence = mug();
  EXPECT_FLOAT_EQ(feature("log_pixels", evidence), std::log(1500.0F));
  EXPECT_FLOAT_EQ(feature("log_longest_side", evidence), std::log(0.13F));
  EXPECT_FLOAT_EQ(feature("middle_by_longest_side", evidence), 0.1F / 0.13F);
  EXPECT_FLOAT_EQ(feature("shortest_by_longest_side", evidence), 0.09F / 0.13F);
}

TEST(ObjectnessEvidence, JoiningOddsAreCertain_WhenItIsOneRegion) {
  ObjectnessEvidence evidence = mug();
  evidence.odds = -1.5F;
  EXPECT_FLOAT_EQ(feature("joining_log_odds", evidence), 4);
  evidence.largest_part = 0.8F;
  EXPECT_FLOAT_EQ(feature("joining_log_odds", evidence), -1.5F);
}

TEST(ObjectnessEvidence, ColorFeaturesAreUnknown_WithoutColor) {
  constexpr std::array kOfColor{"neighbor_likeness",     "touching_likeness", "end_to_end_likeness",
                                "side_to_side_likeness", "contrast_along",    "contrast_across",
                                "likeness_along",        "likeness_across"};
  ObjectnessEvidence evidence = mug();
  for (const char* name : kOfColor) EXPECT_TRUE(std::isnan(feature(name, evidence))) << name;
  evidence.likeness =
      ColorLikeness{.neighbor = 0.9F, .touching = 0.8F, .end_to_end = 0.7F, .side_to_side = 0.6F};
  evidence.changes = ColorChanges{.along = {.contrast = 0.5F, .likeness = 0.3F},
                                  .across = {.contrast = 0.4F, .likeness = 0.2F}};
  float expected = 0.9F;
  for (const char* name : kOfColor) {
    EXPECT_NEAR(feature(name, evidence), expected, 1e-6F) << name;
    expected -= 0.1F;
  }
}

TEST(ObjectnessEvidence, IsMoreLikely_WhenSurroundingColorsDiffer) {
  ObjectnessEvidence evidence = mug();
  evidence.likeness =
      ColorLikeness{.neighbor = 0.9F, .touching = 0.8F, .end_to_end = 0.7F, .side_to_side = 0.6F};
  const float like_all_around = evidence.logOdds();
  evidence.likeness->neighbor = 0.1F;
  evidence.likeness->touching = 0.05F;
  EXPECT_GT(evidence.logOdds(), like_all_around);
}

TEST(ObjectnessEvidence, BoundsAreFeatures) {
  ObjectnessEvidence evidence = mug();
  evidence.bounds = {.mean = 0.9F, .least_side = 0.7F};
  EXPECT_EQ(feature("bounds_mean", evidence), 0.9F);
  EXPECT_EQ(feature("bounds_weakest_side", evidence), 0.7F);
}

TEST(ObjectnessEvidence, IsLessLikely_WhenABooksSpineHasNoBounds) {
  // Bounds matter little for objects that bulge and stand free.
  ObjectnessEvidence evidence = mug();
  evidence.open = 0.15F;
  evidence.hidden = 0.3F;
  evidence.bulge = evidence.known_bulge = 0;
  evidence.known_flatness = 0.06F;
  evidence.known_size_m = {0.2F, 0.05F, 0.02F};
  const float bounded = evidence.logOdds();
  evidence.bounds = {.mean = 0.6F, .least_side = 0.1F};
  EXPECT_LT(evidence.logOdds(), bounded - 0.5F) << "part of an object";
}

TEST(ObjectnessEvidence, OutwardOddsAreLimited) {
  ObjectnessEvidence part = mug();
  EXPECT_EQ(feature("outward_log_odds", part), OutwardOdds::kMin) << "it touches nothing";
  part.outward_odds = 9;
  EXPECT_FLOAT_EQ(feature("outward_log_odds", part), 4);
}

TEST(ObjectnessEvidence, OddsAreFinite_WithoutEvidence) {
  EXPECT_TRUE(std::isfinite(ObjectnessEvidence{}.logOdds()));
  for (const Feature<ObjectnessEvidence>& of : kObjectnessFeatures)
    EXPECT_FALSE(std::isinf(of.of({}))) << of.name;
}

TEST(ObjectnessEvidence, AcceptsAMugAndRejectsAPatchOfTheWall) {
  EXPECT_GT(mug().logOdds(), 1.5F);
  ObjectnessEvidence patch = mug();
  patch.open = 0.1F;
  patch.folded = 0.1F;
  patch.hidden = 0.6F;
  patch.bulge = patch.known_bulge = 0;
  patch.known_flatness = 0.02F;
  patch.known_size_m = {0.6F, 0.3F, 0.01F};
  EXPECT_LT(patch.logOdds(), -1.5F);
}

TEST(ObjectnessEvidence, IsLessLikely_WhenRegionsHardlyJoin) {
  ObjectnessEvidence set = mug();
  set.largest_part = 0.5F;
  set.odds = -2.9F;
  EXPECT_LT(set.logOdds(), mug().logOdds());
}

TEST(ObjectnessEvidence, SupportsAreNoObjects_HoweverTheyLook) {
  ObjectnessEvidence evidence = mug();
  ASSERT_GT(evidence.logOdds(), 0);
  evidence.support = 0.1F;  // a box that now and then carries something
  EXPECT_GT(evidence.logOdds(), 0);
  evidence.support = 0.9F;
  EXPECT_LT(evidence.logOdds(), -1);
}

}  // namespace
}  // namespace scantrove
