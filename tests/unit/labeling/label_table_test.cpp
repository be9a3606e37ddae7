#include "core/labeling/label_table.h"

#include <gtest/gtest.h>

#include <random>

namespace scantrove {
namespace {

constexpr auto kByAlgorithm = LabelTable::Cause::algorithm;

TEST(LabelTable, NewLabelsAreRegionsOfTheirOwn) {
  LabelTable table;
  EXPECT_EQ(table.regionOf(0), RegionId{0});
  const RegionId a = table.newLabel();
  const RegionId b = table.newLabel();
  EXPECT_NE(a, b);
  EXPECT_EQ(table.regionOf(a.value), a);
  EXPECT_EQ(table.labelCount(), 2U);
}

TEST(LabelTable, JoinNamesTheRegionAfterTheFirstAndReachesAllItsLabels) {
  LabelTable table;
  const RegionId a = table.newLabel();
  const RegionId b = table.newLabel();
  const RegionId c = table.newLabel();
  EXPECT_TRUE(table.join(b, c, kByAlgorithm, 1));
  EXPECT_TRUE(table.join(a, c, kByAlgorithm, 2));  // c is b's, so b joins a
  EXPECT_FALSE(table.join(c, b, kByAlgorithm, 3)) << "already one";
  for (const RegionId id : {a, b, c}) EXPECT_EQ(table.regionOf(id.value), a);
  EXPECT_EQ(table.regionOfLabel(), (std::vector<std::uint32_t>{0, a.value, a.value, a.value}));
  EXPECT_EQ(table.log().size(), 2U);
}

TEST(LabelTable, UnlabelledJoinsNothing) {
  LabelTable table;
  const RegionId a = table.newLabel();
  EXPECT_FALSE(table.join(a, RegionId{}, kByAlgorithm, 0));
  EXPECT_FALSE(table.join(RegionId{}, a, kByAlgorithm, 0));
}

TEST(LabelTable, UndoAndRedoGiveWhatReplayingTheLogGives) {
  std::mt19937 random(3);
  LabelTable table;
  for (int i = 0; i < 60; ++i) (void)table.newLabel();
  std::vector<std::vector<std::uint32_t>> history{table.regionOfLabel()};
  while (history.size() < 40) {
    if (table.join(RegionId{1 + static_cast<std::uint32_t>(random() % 60)},
                   RegionId{1 + static_cast<std::uint32_t>(random() % 60)}, kByAlgorithm, 0)) {
      history.push_back(table.regionOfLabel());
    }
  }
  for (std::size_t step = history.size() - 1; step-- > 0;) {
    ASSERT_TRUE(table.undo());
    ASSERT_EQ(table.regionOfLabel(), history[step]);
  }
  EXPECT_FALSE(table.undo());
  for (std::size_t step = 1; step < history.size(); ++step) {
    ASSERT_TRUE(table.redo());
    ASSERT_EQ(table.regionOfLabel(), history[step]);
  }
  EXPECT_FALSE(table.redo());
}

TEST(LabelTable, AJoinAfterAnUndoForgetsWhatCouldBeRedone) {
  LabelTable table;
  const RegionId a = table.newLabel();
  const RegionId b = table.newLabel();
  const RegionId c = table.newLabel();
  table.join(a, b, kByAlgorithm, 0);
  table.undo();
  table.join(a, c, LabelTable::Cause::person, 1);
  EXPECT_FALSE(table.redo());
  EXPECT_EQ(table.regionOf(b.value), b);
  EXPECT_EQ(table.regionOf(c.value), a);
}

}  // namespace
}  // namespace scantrove
