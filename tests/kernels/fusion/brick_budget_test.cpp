#include "core/fusion/brick_budget.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/each_device.h"

namespace scantrove {
namespace {

constexpr std::size_t kGiB = std::size_t{1} << 30;

TEST(BricksThatFit, FollowsBufferAndDeviceMemory) {
  EXPECT_EQ(bricksThatFit({64 * kGiB, kGiB}), 524288);  // 1 GiB in one buffer
  EXPECT_EQ(bricksThatFit({64 * kGiB, kGiB - 1}), 524287);
  EXPECT_EQ(bricksThatFit({kGiB, kGiB}), 149796);  // three pools and the old half of one
  EXPECT_EQ(bricksThatFit({2000 * kGiB, 1000 * kGiB}), kMaxBricks) << "the limit of voxel indices in kernels";
}

TEST(BrickBudget, IsTheRequestOrAQuarterOfMemory_WithinTheDevice) {
  test::onEachDevice([](ComputeContext& compute) {
    const double most = bricksThatFit(compute.memory());
    FusionParams params;
    params.memory_budget_mb = 64;
    EXPECT_EQ(brickBudget(params, compute).bricks, 11650);  // 64 MiB / (11 * 512 + 128)
    params.memory_budget_mb = 1 << 20;
    EXPECT_EQ(brickBudget(params, compute).bricks, static_cast<int>(most));
    params.memory_budget_mb = 0;
    const double machine =
        static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
    EXPECT_EQ(brickBudget(params, compute).bricks,
              static_cast<int>(std::min(most, machine / 4 / kBrickBytes)));
    EXPECT_EQ(brickBudget(params, compute).at_once, compute.isCpu());
    EXPECT_FALSE(brickBudget(params, compute).folder.empty());
  });
}

}  // namespace
}  // namespace scantrove
