#include "core/labeling/border_evidence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "core/geometry/surface_step.h"
#include "core/labeling/border_features.h"

namespace scantrove {
namespace {

constexpr int kVoxels = 1000;
/// Colours of two pieces of one object, and of two different objects.
constexpr ColorComparison kSimilar{3, 1, 0.95F, 10, 0.3F, 6}, kDifferent{30, 25, 0.05F, 0.5F, 0.3F, 6};

/// A long border seen from nearby: an observation of weight 1 within 10^-6.
FragmentContact nearBorder(float bridged_part) {
  FragmentContact contact;
  contact.length_px = 100;
  contact.bridged_px = static_cast<int>(std::lround(100 * bridged_part));
  contact.length_m = 0.5F;
  contact.depth_m = 0.0025F;
  return contact;
}
FragmentContact nearFold(float concavity_rad) {
  FragmentContact contact = nearBorder(0);
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
  FragmentContact contact = nearBorder(1);
  EXPECT_NEAR(after(contact, 0, 1).observations, 1, 1e-4F);
  contact.depth_m = 2.5F;
  EXPECT_NEAR(after(contact, 0, 1).observations, 0.5F, 1e-4F);
  contact.depth_m = 5;
  EXPECT_NEAR(after(contact, 0, 1).observations, 0.2F, 1e-4F);
  contact = nearBorder(1);
  contact.length_px = contact.bridged_px = 4;
  EXPECT_NEAR(after(contact, 0, 1).observations, 0.25F, 1e-4F);
  EXPECT_NEAR(after(contact, 0, 1).bridged, 0.25F, 1e-4F);
}

TEST(BorderEvidence, OlderObservationsFade_WhenNewerAreAdded) {
  BorderEvidence border = after(nearBorder(1), 1, 1000);
  constexpr float kMax = BorderEvidence::kMaxObservations;
  EXPECT_NEAR(border.observations, kMax, 1e-3F);
  EXPECT_NEAR(border.bridged, kMax, 1e-3F);
  for (int i = 0; i < 40; ++i) border.add(nearBorder(0), 0);
  const float remaining = kMax * std::pow(kMax / (kMax + 1), 40.0F);
  EXPECT_NEAR(border.observations, kMax, 1e-3F);
  EXPECT_NEAR(border.bridged, remaining, 1e-3F);
  EXPECT_NEAR(border.shared, remaining, 1e-3F);
}

TEST(BorderEvidence, BendIsTheMeanOfObservationsWithABend) {
  BorderEvidence border;
  border.add(nearFold(0.6F), 0);
  border.add(nearBorder(0), 0);
  border.add(nearFold(0.2F), 0);
  border.add(nearFold(-0.5F), 0);
  EXPECT_NEAR(border.bends, 3, 1e-3F);
  EXPECT_NEAR(border.concavity_rad, 0.1F, 1e-4F);
  EXPECT_NEAR(border.folded, 1.0F / 3, 1e-4F);
  EXPECT_NEAR(border.ridged, 1.0F / 3, 1e-4F);
}

TEST(BorderEvidence, WrongBendIsOverruled_ByLaterObservations) {
  BorderEvidence border = after(nearFold(0), 0, 500);
  for (int i = 0; i < 60; ++i) border.add(nearFold(0.8F), 0);
  EXPECT_GT(border.folded, 0.9F);
}

TEST(BorderEvidence, ColorShiftIsTheMeanOfObservationsWithColor) {
  BorderEvidence border = after(nearBorder(0), 0, 1);
  EXPECT_FALSE(border.color_shift);
  FragmentContact contact = nearBorder(0);
  contact.color_shift = 8;
  border.add(contact, 0);
  EXPECT_FLOAT_EQ(*border.color_shift, 8);
  border.add(nearBorder(0), 0);
  EXPECT_FLOAT_EQ(*border.color_shift, 8);
}

TEST(BorderEvidence, StepsAndFragmentColorsAreMeansOfObservations) {
  FragmentContact contact = nearBorder(0);
  BorderEvidence border = after(contact, 0, 1);
  EXPECT_FALSE(border.colors);
  contact.step_m = 0.02F;
  contact.colors = {9, 6};
  border.add(contact, 0);
  EXPECT_NEAR(border.step_m, 0.01F, 1e-4F);
  ASSERT_TRUE(border.colors);
  EXPECT_FLOAT_EQ(border.colors->difference, 9) << "of the first observation with colour";
  EXPECT_FLOAT_EQ(border.colors->chroma_difference, 6);
  contact.colors = {12, 3};
  border.add(contact, 0);
  EXPECT_NEAR(border.colors->difference, 10, 1e-3F);
  EXPECT_NEAR(border.colors->chroma_difference, 5, 1e-3F);
  contact.colors = {10, 5, 1, 14, 0.7F, 2};
  border.add(contact, 0);
  EXPECT_NEAR(border.colors->shared, 0.625F, 1e-3F) << "a quarter of the way from the default";
  EXPECT_NEAR(border.colors->shared_chroma, 8, 1e-3F);
  EXPECT_NEAR(border.colors->elsewhere, 0.4F, 1e-3F);
  EXPECT_NEAR(border.colors->variety, 5, 1e-3F);
}

TEST(BorderEvidence, FewObservationsSeparateButDoNotJoin) {
  for (const int observations : {0, 1}) {
    const BorderEvidence border = after(nearBorder(1), 1, observations);
    EXPECT_EQ(border.weight(kVoxels, kVoxels, 100), 0) << observations;
  }
  EXPECT_GT(after(nearBorder(1), 1, 3).weight(kVoxels, kVoxels, 100), 0);
  EXPECT_LT(after(nearBorder(0), 0, 1).weight(kVoxels, kVoxels, -100), 0);
}

TEST(BorderEvidence, OddsFollowSegmentsFoldsAndColors) {
  const auto oddsOf = [](const FragmentContact& contact, float shared) {
    return after(contact, shared, 10).logOdds(kVoxels, kVoxels);
  };
  EXPECT_GT(oddsOf(nearBorder(0), 1), oddsOf(nearBorder(0), 0.2F));
  EXPECT_LT(oddsOf(nearFold(1), 0.5F), oddsOf(nearFold(0), 0.5F));
  EXPECT_GT(oddsOf(nearBorder(1), 1), 0);
  EXPECT_LT(oddsOf(nearFold(1), 0), 0);
  FragmentContact similar = nearBorder(1), different = nearBorder(1);
  similar.color_shift = 0.5F;
  different.color_shift = 30;
  EXPECT_GT(oddsOf(similar, 0.5F), oddsOf(different, 0.5F));
  // Different colours of the fragments outweigh all features of the border.
  similar.colors = kSimilar;
  different.colors = kDifferent;
  different.color_shift = similar.color_shift;
  EXPECT_GT(oddsOf(similar, 0.8F), oddsOf(different, 0.8F) + 2);
}

/// A plausible border after some observations.
BorderEvidence randomBorder(std::mt19937& random) {
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
  const float outlines = between(0, BorderEvidence::kMaxObservations);
  border.outlined = outlines * between(0, 1);
  border.unoutlined = outlines - border.outlined;
  const float chroma = between(0, 30);
  const float shared = between(0, 1);
  border.colors = {chroma + between(0, 20), chroma,        shared,
                   shared * between(0, 50), between(0, 1), between(0, 25)};
  return border;
}

// A fit to few samples could violate this, and leaks would then never heal.
TEST(BorderEvidence, OddsAreMonotonicInEachFeature) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> voxels(50, 60000);
  int differ = 0;
  for (int i = 0; i < 2000; ++i) {
    const BorderEvidence border = randomBorder(random);
    const int a = voxels(random), b = voxels(random);
    const float odds = border.logOdds(a, b);
    BorderEvidence shared = border, bridged = border, folded = border, edge = border, different = border,
                   in_common = border, common = border, outlined = border, unoutlined = border;
    shared.shared = (border.shared + border.observations) / 2;
    bridged.bridged = (border.bridged + border.observations) / 2;
    folded.folded = (border.folded + 1) / 2;
    *edge.color_shift += 10;
    different.colors->difference += 10;
    different.colors->chroma_difference += 10;
    in_common.colors->shared = (border.colors->shared + 1) / 2;
    common.colors->elsewhere = (border.colors->elsewhere + 1) / 2;
    outlined.addOutline(true);
    unoutlined.addOutline(false);
    constexpr float kRounding = 1e-4F;
    EXPECT_LE(outlined.logOdds(a, b), odds + kRounding);
    EXPECT_GE(unoutlined.logOdds(a, b), odds - kRounding);
    EXPECT_GE(shared.logOdds(a, b), odds - kRounding);
    EXPECT_GE(bridged.logOdds(a, b), odds - kRounding);
    EXPECT_LE(folded.logOdds(a, b), odds + kRounding);
    EXPECT_LE(edge.logOdds(a, b), odds + kRounding);
    EXPECT_LE(different.logOdds(a, b), odds + kRounding);
    EXPECT_GE(in_common.logOdds(a, b), odds - kRounding);
    EXPECT_LE(common.logOdds(a, b), odds + kRounding);
    different.colors->shared /= 4;
    differ += different.logOdds(a, b) < odds - 0.5F ? 1 : 0;
  }
  EXPECT_GT(differ, 500) << "colours have an effect";
}

TEST(BorderEvidence, OddsAreBetweenSimilarAndDifferent_WithoutColor) {
  std::mt19937 random(2);
  double similar = 0, different = 0, colorless = 0;
  for (int i = 0; i < 200; ++i) {
    BorderEvidence border = randomBorder(random);
    border.color_shift = 1;
    border.colors = kSimilar;
    similar += static_cast<double>(border.logOdds(kVoxels, kVoxels));
    border.color_shift = 30;
    border.colors = kDifferent;
    different += static_cast<double>(border.logOdds(kVoxels, kVoxels));
    border.color_shift.reset();
    border.colors.reset();
    colorless += static_cast<double>(border.logOdds(kVoxels, kVoxels));
  }
  EXPECT_GT(similar, colorless);
  EXPECT_GT(colorless, different);
}

TEST(BorderEvidence, JoiningWeightGrows_WithObservations) {
  for (const int observations : {5, 10, 20}) {
    const BorderEvidence border = after(nearBorder(1), 1, observations);
    const float odds = border.logOdds(kVoxels, kVoxels);
    ASSERT_GT(odds, 0);
    const auto counted = static_cast<float>(border.observations);
    EXPECT_NEAR(border.weight(kVoxels, kVoxels, 0), odds * counted / (counted + 8), 1e-4F) << observations;
    EXPECT_FLOAT_EQ(border.weight(kVoxels, kVoxels, -2 * odds), -odds)
        << "separating evidence counts at once";
  }
}

TEST(BorderEvidence, WeightKeepsThePartition_WhenObservationsAreFew) {
  for (const float bridged : {0.0F, 1.0F}) {
    const BorderEvidence border = after(nearBorder(bridged), bridged, 1);
    ASSERT_LT(border.observations, 2);
    for (const float bias : {-10.0F, 10.0F}) {
      EXPECT_LE(border.weight(kVoxels, kVoxels, bias, false), 0) << "separate fragments stay separate";
      EXPECT_GT(border.weight(kVoxels, kVoxels, bias, true), 0) << "joined fragments stay joined";
    }
  }
}

TEST(BorderEvidence, WeightIsBelowTheOdds_WhenTheBorderIsShort) {
  FragmentContact contact = nearBorder(1);
  contact.length_m = 0.02F;
  const BorderEvidence border = after(contact, 1, 10);
  EXPECT_NEAR(border.weight(kVoxels, kVoxels, -20), 0.2F * (border.logOdds(kVoxels, kVoxels) - 20), 1e-3F);
}

TEST(BorderEvidence, RepeatedAppearancesOverruleOtherEvidence) {
  // Without appearances a clear fold separates, and a flat wall joins.
  BorderEvidence folded = after(nearFold(1.2F), 0, 20), flat = after(nearBorder(1), 1, 20);
  ASSERT_LT(folded.weight(kVoxels, kVoxels, 0), 0);
  ASSERT_GT(flat.weight(kVoxels, kVoxels, 0), 0);
  for (int i = 0; i < 8; ++i) {
    folded.addAppearance(true);
    flat.addAppearance(false);
  }
  EXPECT_GT(folded.weight(kVoxels, kVoxels, 0), 0);
  EXPECT_LT(flat.weight(kVoxels, kVoxels, 0), 0);
  // A single frame may be wrong.
  FragmentContact similar = nearBorder(1);
  similar.color_shift = 1;
  similar.colors = kSimilar;
  BorderEvidence once = after(similar, 1, 20);
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
  // Missing attachment is no evidence for separation.
  BorderEvidence flat = after(nearBorder(1), 1, 20);
  const float before = flat.weight(kVoxels, kVoxels, 0);
  for (int i = 0; i < 20; ++i) flat.addAttachment(false);
  EXPECT_EQ(flat.weight(kVoxels, kVoxels, 0), before);
}

// How much, and what a missing outline means, is up to the model: BorderModel's tests.
TEST(BorderEvidence, OutlineOnASupportSeparates_UnlessObservationsDenyIt) {
  BorderEvidence flat = after(nearBorder(1), 1, 20);
  const float before = flat.weight(kVoxels, kVoxels, 0);
  ASSERT_GT(before, 0);
  for (int i = 0; i < 5; ++i) flat.addOutline(true);
  const float outlined = flat.weight(kVoxels, kVoxels, 0);
  EXPECT_LT(outlined, before - 1);
  for (int i = 0; i < 15; ++i) flat.addOutline(false);
  EXPECT_GT(flat.weight(kVoxels, kVoxels, 0), outlined + 1);
}

TEST(BorderEvidence, OlderOutlinesFade_WhenNewerObservationsDenyThem) {
  BorderEvidence border;
  for (int i = 0; i < 500; ++i) border.addOutline(true);
  EXPECT_NEAR(border.outlined, BorderEvidence::kMaxObservations, 1e-3F);
  for (int i = 0; i < 60; ++i) border.addOutline(false);
  EXPECT_NEAR(border.outlined + border.unoutlined, BorderEvidence::kMaxObservations, 1e-3F);
  EXPECT_GT(border.unoutlined, 0.9F * BorderEvidence::kMaxObservations);
}

TEST(BorderEvidence, ColorFeaturesAreUnknown_WithoutColor) {
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
  border.colors = kSimilar;
  EXPECT_THAT(unknownOf(border), testing::IsEmpty());
}

TEST(BorderEvidence, OddsAreSymmetric_InTheFragments) {
  const BorderEvidence border = after(nearFold(0.3F), 0.4F, 5);
  EXPECT_EQ(border.logOdds(60, 5000), border.logOdds(5000, 60));
}

}  // namespace
}  // namespace scantrove
