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

struct Held {
  explicit Held(std::size_t bricks)
      : voxels(bricks * kBrick), labels(bricks * kBrick), colors(bricks * kBrick) {}
  [[nodiscard]] bool isNothing() const {
    const auto is_unseen = [](const TsdfVoxel& voxel) { return voxel.distance == 0 && voxel.weight == 0; };
    const auto is_zero = [](cl_uint value) { return value == 0; };
    return std::ranges::all_of(voxels, is_unseen) && std::ranges::all_of(labels, is_zero) &&
           std::ranges::all_of(colors, is_zero);
  }
  std::vector<TsdfVoxel> voxels;
  std::vector<cl_uint> labels, colors;
};

Held heldIn(const BrickPools& pools, const std::vector<int>& slots) {
  Held held(slots.size());
  pools.read(slots, held.voxels, held.labels, held.colors);
  return held;
}

Held something() {
  Held held(1);
  std::ranges::fill(held.voxels, TsdfVoxel{-5, 6});
  std::ranges::fill(held.labels, 7U);
  std::ranges::fill(held.colors, 8U);
  return held;
}

double residentMegabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:" && status >> word) return std::stod(word) / 1024;
  }
  return 0;
}

TEST(BrickPools, ASlotIsEmptyWhenItIsHandedOutFirstAndAgain) {
  onEachDevice([](ComputeContext& compute) {
    for (const bool at_once : {true, false}) {
      BrickPools pools(compute);
      if (at_once && !(compute.isCpu() && pools.makeAtOnce(40))) continue;
      if (!at_once) pools.grow(40, 0);
      pools.clear(std::vector{0, 1, 2});
      EXPECT_TRUE(heldIn(pools, {0, 1, 2}).isNothing());
      const Held full = something();
      pools.write(std::vector{1}, full.voxels, full.labels, full.colors);
      pools.write(std::vector{9}, full.voxels, full.labels, full.colors);  // was never cleared
      EXPECT_EQ(heldIn(pools, {9}).labels, full.labels);
      EXPECT_TRUE(heldIn(pools, {0, 2}).isNothing());
      pools.clear(std::vector{9, 10, 1});
      EXPECT_TRUE(heldIn(pools, {0, 1, 2, 9, 10}).isNothing());
    }
  });
}

TEST(BrickPools, StayEmptyBeyondTheRoomThatWasMadeAtOnce) {
  onEachDevice([](ComputeContext& compute) {
    BrickPools pools(compute);
    if (!compute.isCpu() || !pools.makeAtOnce(4)) return;
    const Held full = something();
    pools.write(std::vector{3}, full.voxels, full.labels, full.colors);
    pools.grow(40, 4);
    EXPECT_EQ(heldIn(pools, {3}).colors, full.colors);
    pools.clear(std::vector{3, 20});
    EXPECT_TRUE(heldIn(pools, {3, 20}).isNothing());
  });
}

TEST(BrickPools, BricksWithoutLabelsAndColorsTakeAThird) {
  onEachDevice([](ComputeContext& compute) {
    if (!compute.isCpu()) return;
    constexpr int kBricks = 20'000;  // 40 MB of distances, and as much of labels and of colours
    BrickPools pools(compute);
    ASSERT_TRUE(pools.makeAtOnce(kBricks));
    const double before = residentMegabytes();
    std::vector<int> slots(kBricks);
    std::iota(slots.begin(), slots.end(), 0);
    pools.clear(slots);
    pools.voxels().fill(compute.queue(), TsdfVoxel{1, 2}, 0, kBricks * kBrick);
    compute.finish();
    const double grown = residentMegabytes() - before;
    EXPECT_GT(grown, 35);
    EXPECT_LT(grown, 60);
  });
}

}  // namespace
}  // namespace scantrove::test
