#include "core/dataset/scan_split.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace scantrove::test {
namespace {

std::vector<std::string> scansNamed(int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back("scan " + std::to_string(i));
  return names;
}

int scansIn(const std::map<std::string, DatasetSplit>& splits, DatasetSplit split) {
  return static_cast<int>(
      std::ranges::count_if(splits, [&](const auto& one) { return one.second == split; }));
}

TEST(ParseSplitShares, ReadsNamedAndPlainShares) {
  EXPECT_EQ(parseSplitShares("train=0.8,val=0.1,test=0.1"), (SplitShares{0.8, 0.1, 0.1}));
  EXPECT_EQ(parseSplitShares("test=0.25,train=0.75"), (SplitShares{0.75, 0, 0.25}));
  EXPECT_EQ(parseSplitShares("0.8,0.1,0.1"), (SplitShares{0.8, 0.1, 0.1}));
}

TEST(ParseSplitShares, RefusesAnythingElse) {
  for (const char* text : {"", "train", "train=0.8", "train=0.8,val=0.3", "0.5,0.5,0,0", "train=1,train=0",
                           "train=1.5,val=-0.5", "train=nan,val=1", "dev=1", "a,b,c", ","}) {
    const auto shares = parseSplitShares(text);
    ASSERT_FALSE(shares) << text;
    EXPECT_FALSE(shares.error().advice.empty());
  }
}

TEST(DrawSplit, HasTheShares) {
  const auto splits = drawSplit(scansNamed(20), {0.8, 0.1, 0.1}, 0);
  EXPECT_EQ(splits.size(), 20U);
  EXPECT_EQ(scansIn(splits, DatasetSplit::train), 16);
  EXPECT_EQ(scansIn(splits, DatasetSplit::val), 2);
  EXPECT_EQ(scansIn(splits, DatasetSplit::test), 2);
}

TEST(DrawSplit, IsTheSameForASeed_WhateverTheOrder) {
  std::vector<std::string> names = scansNamed(12);
  const auto first = drawSplit(names, {0.5, 0.25, 0.25}, 7);
  std::ranges::reverse(names);
  EXPECT_EQ(drawSplit(names, {0.5, 0.25, 0.25}, 7), first);
  std::set<std::map<std::string, DatasetSplit>> different;
  for (std::uint64_t seed = 0; seed < 8; ++seed) different.insert(drawSplit(names, {0.5, 0.25, 0.25}, seed));
  EXPECT_GE(different.size(), 4U) << "other seeds draw others";
}

TEST(DrawSplit, GivesEachShareAScan_IfThereAreEnough) {
  const auto three = drawSplit(scansNamed(3), {0.9, 0.05, 0.05}, 1);
  for (const DatasetSplit split : kAllSplits) EXPECT_EQ(scansIn(three, split), 1);
  EXPECT_EQ(scansIn(drawSplit(scansNamed(1), {0.1, 0.9, 0}, 1), DatasetSplit::train), 1);
  const auto two = drawSplit(scansNamed(2), {0.8, 0.1, 0.1}, 1);
  EXPECT_EQ(scansIn(two, DatasetSplit::train), 1);
  EXPECT_EQ(scansIn(two, DatasetSplit::val), 1);
  EXPECT_TRUE(drawSplit({}, {1, 0, 0}, 1).empty());
}

}  // namespace
}  // namespace scantrove::test
