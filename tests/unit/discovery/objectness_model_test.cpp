#include "core/discovery/objectness/objectness_model.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/reference/boosted_trees_reference.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

/// Log-odds 3 if over half of the outline is open, else -5. Knows nothing of supports.
constexpr std::string_view kWithoutSupport =
    R"({"features": ["open"], "medians": {}, "prior": 1, "levels": 1, "trees": [[0, 0.5, -6, 2]]})";
/// The same, and 1.5 less for what was seen as a support in over 0.4 of its pixels.
constexpr std::string_view kWithSupport =
    R"({"features": ["support", "open"], "medians": {}, "prior": 1, "levels": 1,
        "trees": [[1, 0.5, -6, 2], [0, 0.4, 0, -1.5]]})";
constexpr std::string_view kWithCarriedOnly =
    R"({"features": ["carried"], "medians": {}, "prior": 1, "levels": 1, "trees": [[0, 0.5, 0, 2]]})";

ObjectnessModel objectnessModelOf(std::string_view json) {
  return ObjectnessModel::parse({"toy.json", json}).value();
}

ObjectnessEvidence evidenceWith(float open, float support) {
  ObjectnessEvidence evidence;
  evidence.open = open;
  evidence.support = support;
  return evidence;
}

TEST(ObjectnessModel, SharesOfSupportAreFeatures) {
  ObjectnessEvidence evidence;
  evidence.support = 0.25F;
  evidence.carried = 0.6F;
  std::map<std::string_view, float> values;
  for (const Feature<ObjectnessEvidence>& feature : kObjectnessFeatures)
    values[feature.name] = feature.of(evidence);
  for (const std::string_view name : kSupportFeatures) ASSERT_TRUE(values.contains(name)) << name;
  EXPECT_EQ(values.at("support"), 0.25F);
  EXPECT_EQ(values.at("carried"), 0.6F);
}

TEST(ObjectnessModel, RuleIsUsed_WhenTheFileDoesNotNameSupport) {
  const ObjectnessModel model = objectnessModelOf(kWithoutSupport);
  EXPECT_FALSE(model.readsSupport());
  EXPECT_FALSE(objectnessModelOf(kWithCarriedOnly).readsSupport());
  EXPECT_EQ(evidenceWith(0.9F, 0.6F).logOdds(model), 3) << "not mostly a support";
  EXPECT_EQ(evidenceWith(0.9F, 0.7F).logOdds(model), -4);
  EXPECT_EQ(evidenceWith(0.1F, 0.7F).logOdds(model), -5) << "the rule only lowers";
}

TEST(ObjectnessModel, TreesReplaceTheRule_WhenTheFileNamesSupport) {
  const ObjectnessModel model = objectnessModelOf(kWithSupport);
  EXPECT_TRUE(model.readsSupport());
  EXPECT_EQ(evidenceWith(0.9F, 0.4F).logOdds(model), 3);
  EXPECT_EQ(evidenceWith(0.9F, 0.5F).logOdds(model), 1.5F);
  EXPECT_EQ(evidenceWith(0.9F, 1).logOdds(model), 1.5F);
}

/// Any evidence, plausible or not.
ObjectnessEvidence anyEvidence(std::mt19937& random) {
  const auto upTo = [&random](float limit) {
    return std::uniform_real_distribution<float>(0, limit)(random);
  };
  ObjectnessEvidence evidence;
  evidence.pixels = upTo(5000);
  evidence.shown = upTo(1);
  for (float ObjectnessEvidence::*part :
       {&ObjectnessEvidence::open, &ObjectnessEvidence::folded, &ObjectnessEvidence::ridged,
        &ObjectnessEvidence::hidden, &ObjectnessEvidence::cut, &ObjectnessEvidence::fill,
        &ObjectnessEvidence::convexity, &ObjectnessEvidence::relief_m, &ObjectnessEvidence::area_m2,
        &ObjectnessEvidence::bulge, &ObjectnessEvidence::known_bulge, &ObjectnessEvidence::known_flatness,
        &ObjectnessEvidence::largest_part, &ObjectnessEvidence::joined_part, &ObjectnessEvidence::support,
        &ObjectnessEvidence::carried})
    evidence.*part = upTo(1);
  evidence.known_size_m = {upTo(1), upTo(0.5F), upTo(0.2F)};
  evidence.is_inconsistent = upTo(1) < 0.5F;
  evidence.odds = upTo(8) - 4;
  evidence.outward_odds = upTo(8) - 4;
  evidence.bounds = {.mean = upTo(1), .least_side = upTo(1)};
  if (upTo(1) < 0.7F) {
    evidence.likeness = ColorLikeness{
        .neighbor = upTo(1), .touching = upTo(1), .end_to_end = upTo(1), .side_to_side = upTo(1)};
    evidence.changes = ColorChanges{.along = {.contrast = upTo(1), .likeness = upTo(1)},
                                    .across = {.contrast = upTo(1), .likeness = upTo(1)}};
  }
  return evidence;
}

TEST(ObjectnessModel, EmbeddedModelSaysWhatItsFileSays) {
  const test::BoostedTreesReference file(
      test::readText(test::sourceTree() / "resources" / "models" / "objectness.json"));
  const ObjectnessModel& model = ObjectnessModel::embedded();
  EXPECT_EQ(model.readsSupport(), file.names("support"));
  std::mt19937 random(6);
  for (int i = 0; i < 200; ++i) {
    const ObjectnessEvidence evidence = anyEvidence(random);
    std::map<std::string, float> values;
    for (const Feature<ObjectnessEvidence>& feature : kObjectnessFeatures)
      values[std::string(feature.name)] = feature.of(evidence);
    const float expected = file.logOdds(values);
    EXPECT_EQ(model.logOdds(evidence), expected);
    if (model.readsSupport()) {
      EXPECT_EQ(evidence.logOdds(), expected);
    } else {
      EXPECT_EQ(evidence.logOdds(), evidence.support > 0.6F ? std::min(expected, -4.0F) : expected);
    }
  }
}

}  // namespace
}  // namespace scantrove
