#include "core/fusion/brick_pools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/each_device.h"

namespace scantrove::test {
namespace {

constexpr std::size_t kBrick = BRICK_VOXELS;

BrickContents filledBrick() {
  BrickContents contents(1);
  std::ranges::fill(contents.distances, cl_short{-5});
  std::ranges::fill(contents.weights, cl_uchar{6});
  std::ranges::fill(contents.labels, 7U);
  std::ranges::fill(contents.colors, 8U);
  return contents;
}

double residentMegabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:" && status >> word) return std::stod(word) / 1024;
  }
  return 0;
}

TEST(BrickPools, ASlotIsEmpty_WhenNewOrReused) {
  onEachDevice([](ComputeContext& compute) {
    for (const bool at_once : {true, false}) {
      BrickPools pools(compute);
      if (at_once && !(compute.isCpu() && pools.makeAtOnce(40))) continue;
      if (!at_once) pools.grow(40, 0);
      pools.clear(std::vector{0, 1, 2});
      EXPECT_EQ(pools.read(std::vector{0, 1, 2}), BrickContents(3));
      const BrickContents full = filledBrick();
      pools.write(std::vector{1}, full);
      pools.write(std::vector{9}, full);  // was never cleared
      EXPECT_EQ(pools.read(std::vector{9}), full);
      EXPECT_EQ(pools.read(std::vector{0, 2}), BrickContents(2));
      pools.clear(std::vector{9, 10, 1});
      EXPECT_EQ(pools.read(std::vector{0, 1, 2, 9, 10}), BrickContents(5));
    }
  });
}

TEST(BrickPools, SlotsAreEmpty_BeyondTheInitialAllocation) {
  onEachDevice([](ComputeContext& compute) {
    BrickPools pools(compute);
    if (!compute.isCpu() || !pools.makeAtOnce(4)) return;
    const BrickContents full = filledBrick();
    pools.write(std::vector{3}, full);
    pools.grow(40, 4);
    EXPECT_EQ(pools.read(std::vector{3}), full);
    pools.clear(std::vector{3, 20});
    EXPECT_EQ(pools.read(std::vector{3, 20}), BrickContents(2));
  });
}

TEST(BrickPools, LabelsAndColorsUseMemory_OnlyOnceWritten) {
  onEachDevice([](ComputeContext& compute) {
    if (!compute.isCpu()) return;
    constexpr int kBricks = 20'000;  // 30 MB of distances and weights, and 80 of labels and colours
    BrickPools pools(compute);
    ASSERT_TRUE(pools.makeAtOnce(kBricks));
    const double before = residentMegabytes();
    std::vector<int> slots(kBricks);
    std::iota(slots.begin(), slots.end(), 0);
    pools.clear(slots);
    pools.distances().fill(compute.queue(), 1, 0, kBricks * kBrick);
    pools.weights().fill(compute.queue(), 2, 0, kBricks * kBrick);
    compute.finish();
    const double grown = residentMegabytes() - before;
    EXPECT_GT(grown, 25);
    EXPECT_LT(grown, 50);
  });
}

}  // namespace
}  // namespace scantrove::test
