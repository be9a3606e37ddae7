#include "core/base/boosted_tree.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

using Tree = BoostedTree<5>;

/// The root asks for feature 0, its children for feature 1, theirs for feature 2, and so on down to feature
/// 4; leaves say 0 .. 31 from left to right.
Tree countingTree() {
  Tree tree{};
  tree.splits = {{{0, 0.5F}, {1, 1}, {1, -1}, {2, 0}, {2, 0}, {2, 0}, {2, 10}}};
  for (std::size_t fourth = 7; fourth < 15; ++fourth) tree.splits[fourth] = {3, 5};
  for (std::size_t last = 15; last < Tree::kSplits; ++last) tree.splits[last] = {4, 7};
  for (std::size_t leaf = 0; leaf < Tree::kLeaves; ++leaf) tree.leaves[leaf] = static_cast<float>(leaf);
  return tree;
}

TEST(BoostedTree, GoesLeftUpToTheLimitAndRightBeyond) {
  const Tree tree = countingTree();
  const auto valueOf = [&tree](float a, float b, float c, float d, float e) {
    return tree.valueOf(std::array{a, b, c, d, e});
  };
  EXPECT_EQ(valueOf(0, 0, -1, 0, 0), 0);
  EXPECT_EQ(valueOf(0.5F, 1, 0, 5, 7), 0) << "the limits themselves";
  EXPECT_EQ(valueOf(0, 0, 0, 0, 8), 1);
  EXPECT_EQ(valueOf(0, 0, 0, 6, 0), 2);
  EXPECT_EQ(valueOf(0, 0, 1, 0, 0), 4);
  EXPECT_EQ(valueOf(0, 2, 0, 0, 0), 8);
  EXPECT_EQ(valueOf(0, 2, 1, 6, 8), 15);
  EXPECT_EQ(valueOf(1, -2, 0, 0, 0), 16);
  EXPECT_EQ(valueOf(1, -2, 1, 6, 0), 22);
  EXPECT_EQ(valueOf(1, 0, 9, 0, 8), 25);
  EXPECT_EQ(valueOf(1, 0, 11, 6, 8), 31);
}

}  // namespace
}  // namespace scantrove
