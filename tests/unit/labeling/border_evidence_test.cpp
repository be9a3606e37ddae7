#include "core/labeling/border_evidence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "core/geometry/surface_step.h"
#include "core/labeling/border_features.h"

namespace scantrove {
namespace {

constexpr int kVoxels = 1000;
/// As two pieces of one thing may be, and as two things may.
constexpr ColorComparison kAlike{3, 1, 0.95F, 10, 0.3F, 6}, kUnlike{30, 25, 0.05F, 0.5F, 0.3F, 6};

/// A long border seen from nearby: a look of weight 1, but for 1 part in 10^6.
FragmentContact nearLook(float bridged_part) {
  FragmentContact contact;
  contact.length_px = 100;
  contact.bridged_px = static_cast<int>(std::lround(100 * bridged_part));
  contact.length_m = 0.5F;
  contact.depth_m = 0.0025F;
  return contact;
}
FragmentContact nearFold(float concavity_rad) {
  FragmentContact contact = nearLook(0);
  contact.bends = contact.length_px;
  contact.concavity_rad = concavity_rad;
  contact.folded = concavity_rad > kClearBend_rad ? 1.0F : 0.0F;
  contact.ridged = concavity_rad < -kClearBend_rad ? 1.0F : 0.0F;
  return contact;
}

BorderEvidence after(const FragmentContact& contact, float shared, int observations) {
  BorderEvidence border;
  for (int i = 0; i < observations; ++i) border.add(contact, shared);
  return border;
}

TEST(BorderEvidence, ObservationsWeighLess_WhenFarOrShort) {
  FragmentContact contact = nearLook(1);
  EXPECT_NEAR(after(contact, 0, 1).observations, 1, 1e-4F);
  contact.depth_m = 2.5F;
  EXPECT_NEAR(after(contact, 0, 1).observations, 0.5F, 1e-4F);
  contact.depth_m = 5;
  EXPECT_NEAR(after(contact, 0, 1).observations, 0.2F, 1e-4F);
  contact = nearLook(1);
  contact.length_px = contact.bridged_px = 4;
  EXPECT_NEAR(after(contact, 0, 1).observations, 0.25F, 1e-4F);
  EXPECT_NEAR(after(contact, 0, 1).bridged, 0.25F, 1e-4F);
}

TEST(BorderEvidence, OlderObservationsFade_WhenNewerAreAdded) {
  BorderEvidence border = after(nearLook(1), 1, 1000);
  constexpr float kMax = BorderEvidence::kMaxObservations;
  EXPECT_NEAR(border.observations, kMax, 1e-3F);
  EXPECT_NEAR(border.bridged, kMax, 1e-3F);
  for (int look = 0; look < 40; ++look) border.add(nearLook(0), 0);
  const float left = kMax * std::pow(kMax / (kMax + 1), 40.0F);
  EXPECT_NEAR(border.observations, kMax, 1e-3F);
  EXPECT_NEAR(border.bridged, left, 1e-3F);
  EXPECT_NEAR(border.shared, left, 1e-3F);
}

TEST(BorderEvidence, BendIsTheMeanOfObservationsWithABend) {
  BorderEvidence border;
  border.add(nearFold(0.6F), 0);
  border.add(nearLook(0), 0);
  border.add(nearFold(0.2F), 0);
  border.add(nearFold(-0.5F), 0);
  EXPECT_NEAR(border.bends, 3, 1e-3F);
  EXPECT_NEAR(border.concavity_rad, 0.1F, 1e-4F);
  EXPECT_NEAR(border.folded, 1.0F / 3, 1e-4F);
  EXPECT_NEAR(border.ridged, 1.0F / 3, 1e-4F);
}

TEST(BorderEvidence, WrongBendIsOverruled_ByLaterObservations) {
  BorderEvidence border = after(nearFold(0), 0, 500);
  for (int look = 0; look < 60; ++look) border.add(nearFold(0.8F), 0);
  EXPECT_GT(border.folded, 0.9F);
}

TEST(BorderEvidence, ColorShiftIsTheMeanOfObservationsWithColor) {
  BorderEvidence border = after(nearLook(0), 0, 1);
  EXPECT_FALSE(border.color_shift);
  FragmentContact contact = nearLook(0);
  contact.color_shift = 8;
  border.add(contact, 0);
  EXPECT_FLOAT_EQ(*border.color_shift, 8);
  border.add(nearLook(0), 0);
  EXPECT_FLOAT_EQ(*border.color_shift, 8);
}

TEST(BorderEvidence, StepsAndFragmentColorsAreMeansOfObservations) {
  FragmentContact contact = nearLook(0);
  BorderEvidence border = after(contact, 0, 1);
  EXPECT_FALSE(border.colors);
  contact.step_m = 0.02F;
  contact.colors = {9, 6};
  border.add(contact, 0);
  EXPECT_NEAR(border.step_m, 0.01F, 1e-4F);
  ASSERT_TRUE(border.colors);
  EXPECT_FLOAT_EQ(border.colors->difference, 9) << "the first that had it";
  EXPECT_FLOAT_EQ(border.colors->chroma_difference, 6);
  contact.colors = {12, 3};
  border.add(contact, 0);
  EXPECT_NEAR(border.colors->difference, 10, 1e-3F);
  EXPECT_NEAR(border.colors->chroma_difference, 5, 1e-3F);
  contact.colors = {10, 5, 1, 14, 0.7F, 2};
  border.add(contact, 0);
  EXPECT_NEAR(border.colors->shared, 0.625F, 1e-3F) << "a quarter of the way from what is usual";
  EXPECT_NEAR(border.colors->shared_chroma, 8, 1e-3F);
  EXPECT_NEAR(border.colors->elsewhere, 0.4F, 1e-3F);
  EXPECT_NEAR(border.colors->variety, 5, 1e-3F);
}

TEST(BorderEvidence, FewObservationsSeparateButDoNotJoin) {
  for (const int observations : {0, 1}) {
    const BorderEvidence border = after(nearLook(1), 1, observations);
    EXPECT_EQ(border.weight(kVoxels, kVoxels, 100), 0) << observations;
  }
  EXPECT_GT(after(nearLook(1), 1, 3).weight(kVoxels, kVoxels, 100), 0);
  EXPECT_LT(after(nearLook(0), 0, 1).weight(kVoxels, kVoxels, -100), 0);
}

TEST(BorderEvidence, OddsFollowSegmentsFoldsAndColors) {
  const auto oddsOf = [](const FragmentContact& contact, float shared) {
    return after(contact, shared, 10).logOdds(kVoxels, kVoxels);
  };
  EXPECT_GT(oddsOf(nearLook(0), 1), oddsOf(nearLook(0), 0.2F));
  EXPECT_LT(oddsOf(nearFold(1), 0.5F), oddsOf(nearFold(0), 0.5F));
  EXPECT_GT(oddsOf(nearLook(1), 1), 0);
  EXPECT_LT(oddsOf(nearFold(1), 0), 0);
  FragmentContact alike = nearLook(1), unlike = nearLook(1);
  alike.color_shift = 0.5F;
  unlike.color_shift = 30;
  EXPECT_GT(oddsOf(alike, 0.5F), oddsOf(unlike, 0.5F));
  // Colours that differ on the whole say more than anything at the border.
  alike.colors = kAlike;
  unlike.colors = kUnlike;
  unlike.color_shift = alike.color_shift;
  EXPECT_GT(oddsOf(alike, 0.8F), oddsOf(unlike, 0.8F) + 2);
}

/// A border as it may be after some looks.
BorderEvidence anyBorder(std::mt19937& random) {
  const auto between = [&random](float from, float to) {
    return std::uniform_real_distribution<float>(from, to)(random);
  };
  BorderEvidence border;
  border.observations = between(2, BorderEvidence::kMaxObservations);
  border.shared = border.observations * between(0, 1);
  border.bridged = border.observations * between(0, 1);
  border.concavity_rad = between(-1.5F, 1.5F);
  border.folded = between(0, 1);
  border.ridged = between(0, 1 - border.folded);
  border.color_shift = between(0, 40);
  border.step_m = between(0, 0.02F);
  const float chroma = between(0, 30);
  const float shared = between(0, 1);
  border.colors = {chroma + between(0, 20), chroma,        shared,
                   shared * between(0, 50), between(0, 1), between(0, 25)};
  return border;
}

// Few samples of a fit may say otherwise; a leak heals only if this holds.
TEST(BorderEvidence, OddsAreMonotonicInEachFeature) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> voxels(50, 60000);
  int differ = 0;
  for (int i = 0; i < 2000; ++i) {
    const BorderEvidence border = anyBorder(random);
    const int a = voxels(random), b = voxels(random);
    const float odds = border.logOdds(a, b);
    BorderEvidence shared = border, bridged = border, folded = border, edge = border, unlike = border,
                   in_common = border, common = border;
    shared.shared = (border.shared + border.observations) / 2;
    bridged.bridged = (border.bridged + border.observations) / 2;
    folded.folded = (border.folded + 1) / 2;
    *edge.color_shift += 10;
    unlike.colors->difference += 10;
    unlike.colors->chroma_difference += 10;
    in_common.colors->shared = (border.colors->shared + 1) / 2;
    common.colors->elsewhere = (border.colors->elsewhere + 1) / 2;
    constexpr float kRounding = 1e-4F;
    EXPECT_GE(shared.logOdds(a, b), odds - kRounding);
    EXPECT_GE(bridged.logOdds(a, b), odds - kRounding);
    EXPECT_LE(folded.logOdds(a, b), odds + kRounding);
    EXPECT_LE(edge.logOdds(a, b), odds + kRounding);
    EXPECT_LE(unlike.logOdds(a, b), odds + kRounding);
    EXPECT_GE(in_common.logOdds(a, b), odds - kRounding);
    EXPECT_LE(common.logOdds(a, b), odds + kRounding);
    unlike.colors->shared /= 4;
    differ += unlike.logOdds(a, b) < odds - 0.5F ? 1 : 0;
  }
  EXPECT_GT(differ, 500) << "colours are heard at all";
}

TEST(BorderEvidence, OddsAreBetweenSimilarAndDifferent_WithoutColor) {
  std::mt19937 random(2);
  double alike = 0, unlike = 0, unseen = 0;
  for (int i = 0; i < 200; ++i) {
    BorderEvidence border = anyBorder(random);
    border.color_shift = 1;
    border.colors = kAlike;
    alike += static_cast<double>(border.logOdds(kVoxels, kVoxels));
    border.color_shift = 30;
    border.colors = kUnlike;
    unlike += static_cast<double>(border.logOdds(kVoxels, kVoxels));
    border.color_shift.reset();
    border.colors.reset();
    unseen += static_cast<double>(border.logOdds(kVoxels, kVoxels));
  }
  EXPECT_GT(alike, unseen);
  EXPECT_GT(unseen, unlike);
}

TEST(BorderEvidence, JoiningWeightGrows_WithObservations) {
  for (const int observations : {5, 10, 20}) {
    const BorderEvidence border = after(nearLook(1), 1, observations);
    const float odds = border.logOdds(kVoxels, kVoxels);
    ASSERT_GT(odds, 0);
    const auto counted = static_cast<float>(border.observations);
    EXPECT_NEAR(border.weight(kVoxels, kVoxels, 0), odds * counted / (counted + 8), 1e-4F) << observations;
    EXPECT_FLOAT_EQ(border.weight(kVoxels, kVoxels, -2 * odds), -odds)
        << "what speaks against it does not wait";
  }
}

TEST(BorderEvidence, PartitionStays_WhenObservationsAreFew) {
  for (const float bridged : {0.0F, 1.0F}) {
    const BorderEvidence border = after(nearLook(bridged), bridged, 1);
    ASSERT_LT(border.observations, 2);
    for (const float bias : {-10.0F, 10.0F}) {
      EXPECT_LE(border.weight(kVoxels, kVoxels, bias, false), 0) << "what is apart stays so";
      EXPECT_GT(border.weight(kVoxels, kVoxels, bias, true), 0) << "what is one stays so";
    }
  }
}

TEST(BorderEvidence, WeightIsBelowTheOdds_WhenTheBorderIsShort) {
  FragmentContact contact = nearLook(1);
  contact.length_m = 0.02F;
  const BorderEvidence border = after(contact, 1, 10);
  EXPECT_NEAR(border.weight(kVoxels, kVoxels, -20), 0.2F * (border.logOdds(kVoxels, kVoxels) - 20), 1e-3F);
}

TEST(BorderEvidence, RepeatedAppearancesOverruleOtherEvidence) {
  // By the looks alone a clear fold parts, and a wall is one.
  BorderEvidence folded = after(nearFold(1.2F), 0, 20), flat = after(nearLook(1), 1, 20);
  ASSERT_LT(folded.weight(kVoxels, kVoxels, 0), 0);
  ASSERT_GT(flat.weight(kVoxels, kVoxels, 0), 0);
  for (int i = 0; i < 8; ++i) {
    folded.addAppearance(true);
    flat.addAppearance(false);
  }
  EXPECT_GT(folded.weight(kVoxels, kVoxels, 0), 0);
  EXPECT_LT(flat.weight(kVoxels, kVoxels, 0), 0);
  // One frame alone may be wrong.
  FragmentContact alike = nearLook(1);
  alike.color_shift = 1;
  alike.colors = kAlike;
  BorderEvidence once = after(alike, 1, 20);
  const float before = once.weight(kVoxels, kVoxels, 0);
  ASSERT_GT(before, 0);
  once.addAppearance(false);
  EXPECT_EQ(once.weight(kVoxels, kVoxels, 0), before);
  BorderEvidence appeared_once = after(nearFold(1.2F), 0, 20);
  appeared_once.addAppearance(true);
  EXPECT_LT(appeared_once.weight(kVoxels, kVoxels, 0), 0);
}

TEST(BorderEvidence, AttachmentJoins_UnlessObservationsDenyIt) {
  BorderEvidence folded = after(nearFold(1.2F), 0, 20);
  ASSERT_LT(folded.weight(kVoxels, kVoxels, 0), 0);
  for (int i = 0; i < 12; ++i) folded.addAttachment(true);
  EXPECT_GT(folded.weight(kVoxels, kVoxels, 0), 0);
  for (int i = 0; i < 6; ++i) folded.addAttachment(false);
  EXPECT_LT(folded.weight(kVoxels, kVoxels, 0), 0);
  // That one is not held by another says nothing against their being one.
  BorderEvidence flat = after(nearLook(1), 1, 20);
  const float before = flat.weight(kVoxels, kVoxels, 0);
  for (int i = 0; i < 20; ++i) flat.addAttachment(false);
  EXPECT_EQ(flat.weight(kVoxels, kVoxels, 0), before);
}

TEST(BorderEvidence, EveryFeatureThatNeedsColorIsUnknownWithoutIt) {
  const auto unknownOf = [](const BorderEvidence& border) {
    std::vector<std::string_view> unknown;
    for (const Feature<SizedBorder>& feature : kBorderFeatures) {
      if (std::isnan(feature.of({border, 60, 5000}))) unknown.push_back(feature.name);
    }
    return unknown;
  };
  BorderEvidence border = after(nearFold(0.3F), 0.4F, 5);
  EXPECT_THAT(unknownOf(border),
              testing::ElementsAre("color_shift", "chroma_difference", "color_difference", "shared_colors",
                                   "shared_chroma", "elsewhere", "variety"));
  border.color_shift = 3;
  border.colors = kAlike;
  EXPECT_THAT(unknownOf(border), testing::IsEmpty());
}

TEST(BorderEvidence, DoesNotMatterWhichFragmentIsWhich) {
  const BorderEvidence border = after(nearFold(0.3F), 0.4F, 5);
  EXPECT_EQ(border.logOdds(60, 5000), border.logOdds(5000, 60));
}

}  // namespace
}  // namespace scantrove
