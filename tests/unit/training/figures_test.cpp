#include "tools/train/figures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <iterator>
#include <random>
#include <sstream>

#include "core/base/text.h"
#include "core/labeling/border_features.h"
#include "tools/train/feature_choice.h"

namespace scantrove::train {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Figures, KindOfASceneIsInItsName) {
  EXPECT_EQ(kindOf("room:161"), SceneKind::plain);
  EXPECT_EQ(kindOf("moving:171"), SceneKind::plain);
  EXPECT_EQ(kindOf("tabletop:401:uneven"), SceneKind::uneven);
  EXPECT_EQ(kindOf("room:261:drab"), SceneKind::drab);
  EXPECT_EQ(kindOf("room:501:hard"), SceneKind::hard);
  EXPECT_EQ(kindOf("room:503:uneven:hard"), SceneKind::hard);
  EXPECT_EQ(kindOf("room:503:hard:drab"), SceneKind::hard);
  EXPECT_EQ(kindOf("hands:507"), SceneKind::hard) << "hands have no other generation";
  EXPECT_EQ(kindOf("hardware:1"), SceneKind::plain);
}

TEST(Figures, LogLossIsTheMeanOfTheLogarithmsByWeight) {
  const std::vector<Answer> answers{{true, 1}, {false, 1}, {true, 2}};
  const std::vector<float> odds{0.5F, 1.5F, -2};
  const auto probability = [](double log_odds) { return 1 / (1 + std::exp(-log_odds)); };
  const double expected =
      -(std::log(probability(0.5)) + std::log(1 - probability(1.5)) + 2 * std::log(probability(-2))) / 4;
  EXPECT_NEAR(logLoss(answers, odds), expected, 1e-9);
  const std::vector<float> certain{500, 500, 500};
  EXPECT_NEAR(logLoss(answers, certain), 500.0 / 4, 1e-6) << "no overflow";
  EXPECT_TRUE(std::isnan(logLoss({}, {})));
}

TEST(Figures, AreaCountsPairsInTheRightOrder) {
  std::mt19937 random(3);
  std::vector<Answer> answers;
  std::vector<float> odds;
  for (int i = 0; i < 60; ++i) {
    answers.push_back({random() % 3 == 0, static_cast<float>(1 + random() % 4)});
    odds.push_back(static_cast<float>(random() % 10) +
                   (answers.back().is_yes ? 2.0F : 0.0F));  // with equal ones
  }
  double right = 0, pairs = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    for (std::size_t j = 0; j < answers.size(); ++j) {
      if (!answers[i].is_yes || answers[j].is_yes) continue;
      const double weight = static_cast<double>(answers[i].weight) * static_cast<double>(answers[j].weight);
      pairs += weight;
      right += weight * (odds[i] > odds[j] ? 1 : odds[i] == odds[j] ? 0.5 : 0);
    }
  }
  EXPECT_NEAR(areaUnderCurve(answers, odds), right / pairs, 1e-9);
  EXPECT_TRUE(std::isnan(areaUnderCurve(std::vector<Answer>{{true}, {true}}, std::vector<float>{1, 2})));
}

TEST(Figures, TableHasARowForEachKindThatOccurs) {
  Figures figures({{true, 1, SceneKind::plain, true},
                   {false, 1, SceneKind::plain, false},
                   {true, 1, SceneKind::hard, true},
                   {false, 1, SceneKind::hard, true}});
  figures.add("old", {0, 0, 0, 0});
  figures.add("new", {3, -3, -3, 3});
  const std::string table = figures.table();
  std::vector<std::vector<std::string>> rows;
  for (const std::string_view line : splitLines(table)) {
    std::istringstream words{std::string(line)};
    rows.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
  }
  ASSERT_EQ(rows.size(), 5U) << table;
  EXPECT_THAT(rows[0], ElementsAre("scenes", "samples", "yes", "old", "new"));
  // log(2); log(1 + exp(-3)); log(1 + exp(3)); the mean of these two
  EXPECT_THAT(rows[1], ElementsAre("plain", "2", "0.500", "0.6931", "0.5000", "0.0486", "1.0000"));
  EXPECT_THAT(rows[2], ElementsAre("hard", "2", "0.500", "0.6931", "0.5000", "3.0486", "0.0000"));
  EXPECT_THAT(rows[3], ElementsAre("all", "4", "0.500", "0.6931", "0.5000", "1.5486", "0.5000"));
  EXPECT_THAT(rows[4], ElementsAre("on", "supports", "3", "0.667", "0.6931", "0.5000", "2.0486", "0.2500"));
}

TEST(FeatureChoice, LeavesNamedFeaturesOut) {
  const std::vector<std::string> left_out{"outlined", "support"};  // one of another table
  const FeatureChoice choice(kBorderFeatures, left_out);
  ASSERT_EQ(choice.names().size(), kBorderFeatures.size() - 1);
  EXPECT_TRUE(choice.hasAnyOf(kOutlineFeatures));
  EXPECT_FALSE(FeatureChoice(kBorderFeatures, kOutlineFeatures).hasAnyOf(kOutlineFeatures));
  std::vector<float> all;
  for (std::size_t f = 0; f < kBorderFeatures.size(); ++f) all.push_back(static_cast<float>(f));
  const std::vector<float> chosen = choice.of(all);
  ASSERT_EQ(chosen.size(), choice.names().size());
  for (std::size_t f = 0; f < chosen.size(); ++f)
    EXPECT_EQ(kBorderFeatures[static_cast<std::size_t>(chosen[f])].name, choice.names()[f]);
}

}  // namespace
}  // namespace scantrove::train
