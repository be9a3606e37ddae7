// Training with XGBoost on samples that are made here.
#include <gmock/gmock.h>

#include <random>

#include "core/discovery/objectness/objectness_model.h"
#include "core/labeling/border_model.h"
#include "tools/train/models.h"

namespace scantrove::train {
namespace {

using testing::HasSubstr;
using testing::Not;

template <class Table>
std::size_t columnOf(const Table& table, std::string_view name) {
  std::size_t column = 0;
  while (table[column].name != name) ++column;
  return column;
}

/// Scenes in which nothing but the supports tells what is one object: each second border is outlined in all
/// of its observations and between two objects, each second set is a support and no object.
std::vector<SceneSamples> scenesWithSupports() {
  const std::size_t outlined = columnOf(kBorderFeatures, "outlined");
  const std::size_t support = columnOf(kObjectnessFeatures, "support");
  std::mt19937 random(1);
  const auto any = [&random] { return std::uniform_real_distribution<float>(0, 1)(random); };
  std::vector<SceneSamples> scenes;
  for (int i = 0; i < 10; ++i) {
    SceneSamples& scene = scenes.emplace_back();
    scene.origin = {"room:" + std::to_string(i) + (i % 2 == 0 ? ":hard" : ""), 30, "abc123"};
    for (std::uint32_t j = 0; j < 200; ++j) {
      BorderSample border;
      for (std::size_t f = 0; f < kBorderFeatures.size(); ++f) border.x.push_back(any());
      border.is_same_object = j % 2 == 0;
      border.x[outlined] = border.is_same_object ? 0.0F : 12.0F;
      border.x[outlined + 1] = border.is_same_object ? 8.0F : 0.0F;
      border.x[outlined + 2] = border.is_same_object ? 0.0F : 1.0F;
      scene.borders.push_back(border);
      ObjectnessSample set;
      for (std::size_t f = 0; f < kObjectnessFeatures.size(); ++f) set.x.push_back(any());
      set.regions = {j};
      set.overlap = j % 2 == 0 ? 0.9F : 0.1F;
      set.object = static_cast<int>(j) + 1;
      set.x[support] = j % 2 == 0 ? 0.1F * any() : 0.5F + 0.5F * any();
      scene.objectness.push_back(set);
    }
  }
  return scenes;
}

TEST(ModelTraining, BorderModelLearnsOutlines) {
  const auto trained = trainBorder(scenesWithSupports(), {.trees = 30, .left_out = {}});
  ASSERT_TRUE(trained) << trained.error().message();
  EXPECT_THAT(trained->file, HasSubstr("\"outlined_part\""));
  EXPECT_THAT(trained->file, HasSubstr("demo:room:0:hard demo:room:1"));
  EXPECT_THAT(trained->figures, HasSubstr("supports read"));
  EXPECT_THAT(trained->figures, HasSubstr("\nhard "));
  EXPECT_THAT(trained->figures, HasSubstr("\nplain "));
  const auto model = BorderModel::parse({"border.json", trained->file});
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_TRUE(model->readsOutlines());
  BorderEvidence border;
  for (int i = 0; i < 8; ++i) border.addOutline(false);
  EXPECT_GT(model->logOdds({border, 1000, 1000}), 1);
  for (int i = 0; i < 60; ++i) border.addOutline(true);
  EXPECT_LT(model->logOdds({border, 1000, 1000}), -1);
}

TEST(ModelTraining, BorderModelDoesNotReadWhatIsLeftOut) {
  const auto trained = trainBorder(
      scenesWithSupports(), {.trees = 5, .left_out = {kOutlineFeatures.begin(), kOutlineFeatures.end()}});
  ASSERT_TRUE(trained) << trained.error().message();
  EXPECT_THAT(trained->file, Not(HasSubstr("outlined")));
  const auto model = BorderModel::parse({"border.json", trained->file});
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_FALSE(model->readsOutlines());
}

TEST(ModelTraining, ObjectnessModelLearnsSupports) {
  const auto trained = trainObjectness(scenesWithSupports(), {.trees = 60, .left_out = {"carried"}});
  ASSERT_TRUE(trained) << trained.error().message();
  EXPECT_THAT(trained->figures, HasSubstr("purity"));
  const auto model = ObjectnessModel::parse({"objectness.json", trained->file});
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_TRUE(model->readsSupport());
  EXPECT_THAT(trained->file, Not(HasSubstr("\"carried\"")));
  ObjectnessEvidence evidence;
  const float odds = evidence.logOdds(*model);
  evidence.support = 0.9F;
  EXPECT_LT(evidence.logOdds(*model), odds - 1);
}

TEST(ModelTraining, SameSamplesGiveTheSameModel) {
  const auto first = trainBorder(scenesWithSupports(), {.trees = 5, .left_out = {}});
  const auto second = trainBorder(scenesWithSupports(), {.trees = 5, .left_out = {}});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->file, second->file);
}

TEST(ModelTraining, SaysSo_WhenAllAnswersAreTheSame) {
  std::vector<SceneSamples> scenes = scenesWithSupports();
  for (SceneSamples& scene : scenes)
    for (BorderSample& border : scene.borders) border.is_same_object = true;
  const auto trained = trainBorder(scenes, {.trees = 5, .left_out = {}});
  ASSERT_FALSE(trained);
  EXPECT_THAT(trained.error().message(), HasSubstr("same answer"));
}

}  // namespace
}  // namespace scantrove::train
