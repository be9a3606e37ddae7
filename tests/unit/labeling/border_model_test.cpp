#include "core/labeling/border_model.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/reference/boosted_trees_reference.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

constexpr int kSmaller = 900, kLarger = 12000;  // voxels

/// Log-odds 2.5 if over half is bridged, 0.5 otherwise. Knows nothing of supports.
constexpr std::string_view kWithoutOutlines =
    R"({"features": ["bridged_part"], "medians": {}, "prior": 1.5, "levels": 1, "trees": [[0, 0.5, -1, 1]]})";
/// The same, and 8 less if over half of the supports' observations have an outline.
constexpr std::string_view kWithOutlines =
    R"({"features": ["outlined_part", "bridged_part"], "medians": {}, "prior": 1.5, "levels": 1,
        "trees": [[1, 0.5, -1, 1], [0, 0.5, 0, -8]]})";

BorderModel modelOf(std::string_view json) { return BorderModel::parse({"toy.json", json}).value(); }

/// A long border, seen often.
BorderEvidence flatBorder() {
  BorderEvidence border;
  border.observations = BorderEvidence::kMaxObservations;
  border.bridged = border.shared = 0.9F * border.observations;
  border.length_m = 1;
  return border;
}

float feature(std::string_view name, const BorderEvidence& border) {
  const auto of = std::ranges::find(kBorderFeatures, name, &Feature<SizedBorder>::name);
  return of == kBorderFeatures.end() ? throw std::out_of_range(std::string(name))
                                     : of->of({border, kSmaller, kLarger});
}

TEST(BorderModel, OutlinesAreFeatures) {
  BorderEvidence border;
  EXPECT_EQ(feature("outlined", border), 0);
  EXPECT_EQ(feature("unoutlined", border), 0);
  EXPECT_EQ(feature("outlined_part", border), 0) << "no observation";
  border.addOutline(false);
  EXPECT_EQ(feature("outlined_part", border), 0);
  for (int i = 0; i < 3; ++i) border.addOutline(true);
  EXPECT_EQ(feature("outlined", border), 3);
  EXPECT_EQ(feature("unoutlined", border), 1);
  EXPECT_FLOAT_EQ(feature("outlined_part", border), 0.75F);
  for (const std::string_view name : kOutlineFeatures) EXPECT_NO_THROW((void)feature(name, border)) << name;
}

TEST(BorderModel, RuleIsUsed_WhenTheFileDoesNotNameOutlines) {
  const BorderModel model = modelOf(kWithoutOutlines);
  EXPECT_FALSE(model.readsOutlines());
  BorderEvidence border = flatBorder();
  const float odds = border.logOdds(kSmaller, kLarger, model);
  const float before = border.weight(kSmaller, kLarger, 0, false, model);
  ASSERT_GT(before, 0);
  // 6 (outlined - unoutlined) / max(3, outlined + unoutlined), if positive
  border.outlined = 1;
  EXPECT_FLOAT_EQ(border.weight(kSmaller, kLarger, 0, false, model), before - 2);
  border.outlined = 5;
  EXPECT_FLOAT_EQ(border.weight(kSmaller, kLarger, 0, false, model), before - 6);
  border.unoutlined = 3;
  EXPECT_FLOAT_EQ(border.weight(kSmaller, kLarger, 0, false, model), before - 1.5F);
  EXPECT_EQ(border.logOdds(kSmaller, kLarger, model), odds) << "the rule is no part of them";
  for (const float denied : {5.0F, 9.0F}) {
    border.unoutlined = denied;
    EXPECT_EQ(border.weight(kSmaller, kLarger, 0, false, model), before)
        << "a missing outline is no evidence for joining";
  }
}

TEST(BorderModel, TreesReplaceTheRule_WhenTheFileNamesOutlines) {
  const BorderModel model = modelOf(kWithOutlines), without = modelOf(kWithoutOutlines);
  EXPECT_TRUE(model.readsOutlines());
  BorderEvidence border = flatBorder();
  EXPECT_EQ(border.weight(kSmaller, kLarger, 0, false, model),
            border.weight(kSmaller, kLarger, 0, false, without));
  const float odds = border.logOdds(kSmaller, kLarger, model);
  const float before = border.weight(kSmaller, kLarger, 0, false, model);
  border.outlined = 5;
  border.unoutlined = 6;
  EXPECT_EQ(border.weight(kSmaller, kLarger, 0, false, model), before);
  border.unoutlined = 4;
  EXPECT_FLOAT_EQ(border.logOdds(kSmaller, kLarger, model), odds - 8);
  EXPECT_FLOAT_EQ(border.weight(kSmaller, kLarger, 0, false, model), odds - 8) << "once";
}

TEST(BorderModel, NamesTheFeature_WhenTheFileHasAnother) {
  const auto model = BorderModel::parse(
      {"models/new.json",
       R"({"features": ["warmth"], "medians": {}, "prior": 0, "levels": 1, "trees": [[0, 0.5, -1, 1]]})"});
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message(),
              testing::AllOf(testing::HasSubstr("models/new.json"), testing::HasSubstr("'warmth'")));
}

/// Any border after some observations.
BorderEvidence anyBorder(std::mt19937& random) {
  const auto upTo = [&random](float limit) {
    return std::uniform_real_distribution<float>(0, limit)(random);
  };
  BorderEvidence border;
  border.observations = upTo(20);
  border.shared = border.observations * upTo(1);
  border.bridged = border.observations * upTo(1);
  border.concavity_rad = upTo(3) - 1.5F;
  border.folded = upTo(1);
  border.ridged = upTo(1);
  border.step_m = upTo(0.02F);
  border.length_m = upTo(0.3F);
  border.outlined = upTo(10);
  border.unoutlined = upTo(10);
  if (upTo(1) < 0.7F) {
    border.color_shift = upTo(40);
    border.colors = {upTo(50), upTo(30), upTo(1), upTo(50), upTo(1), upTo(25)};
  }
  return border;
}

TEST(BorderModel, EmbeddedModelSaysWhatItsFileSays) {
  const test::BoostedTreesReference file(
      test::readText(test::sourceTree() / "resources" / "models" / "border.json"));
  const BorderModel& model = BorderModel::embedded();
  EXPECT_EQ(model.readsOutlines(), file.names("outlined") || file.names("outlined_part"));
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const BorderEvidence border = anyBorder(random);
    std::map<std::string, float> values;
    for (const Feature<SizedBorder>& feature : kBorderFeatures)
      values[std::string(feature.name)] = feature.of({border, kSmaller, kLarger});
    EXPECT_EQ(model.logOdds({border, kLarger, kSmaller}), file.logOdds(values));
    if (model.readsOutlines()) continue;
    BorderEvidence other = border;
    other.outlined = 20 - border.outlined;
    other.unoutlined = 0;
    EXPECT_EQ(other.logOdds(kSmaller, kLarger), border.logOdds(kSmaller, kLarger));
  }
}

}  // namespace
}  // namespace scantrove
