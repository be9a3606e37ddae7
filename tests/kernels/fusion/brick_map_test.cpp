#include "core/fusion/brick_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "tests/support/analytic_scene.h"
#include "tests/support/brick_contents.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

std::vector<cl_int> slotsInView(const BrickMap& map, const Eigen::Isometry3d& T_world_camera,
                                const Intrinsics& K, float min_depth_m, float max_depth_m) {
  const ViewFrustum frustum(T_world_camera, K, double{min_depth_m}, double{max_depth_m});
  return map.device().slotsInPages(map.pages().pagesInView(frustum, BRICK_SIDE * double{map.voxelSize()}),
                                   frustum);
}

using Brick = Eigen::Vector3i;

// find_brick of brick_lookup.clh, on the table read back from the device.
int lookUp(const std::vector<BrickEntry>& table, cl_uint mask, const Brick& brick) {
  cl_uint i = brick_hash(brick.x(), brick.y(), brick.z()) & mask;
  while (table[i].slot != BRICK_NONE) {
    if (table[i].x == brick.x() && table[i].y == brick.y() && table[i].z == brick.z()) return table[i].slot;
    i = (i + 1) & mask;
  }
  return BRICK_NONE;
}

std::vector<Brick> randomBricks(std::size_t count, int extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(-extent, extent);
  std::vector<Brick> bricks;
  while (bricks.size() < count)
    bricks.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  return bricks;
}

void expectEqualTables(ComputeContext& compute, const BrickMap& map, const std::vector<Brick>& bricks) {
  const std::vector<BrickEntry> table = map.device().table().read(compute.queue());
  ASSERT_EQ(table.size(), map.device().tableMask() + std::size_t{1});
  for (const Brick& brick : bricks) {
    const int slot = map.device().slotOf(brick);
    ASSERT_NE(slot, BRICK_NONE);
    ASSERT_EQ(map.device().positionOf(slot), brick);
    ASSERT_EQ(lookUp(table, map.device().tableMask(), brick), slot);
  }
  const auto used =
      std::count_if(table.begin(), table.end(), [](const BrickEntry& e) { return e.slot != BRICK_NONE; });
  EXPECT_EQ(used, map.brickCount());
  EXPECT_LE(2 * map.brickCount(), static_cast<int>(table.size()));
}

TEST(BrickMap, AssignsSlotsInOrderAndIgnoresDuplicates) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, 0.01F);
    EXPECT_EQ(map.brickCount(), 0);
    EXPECT_EQ(map.device().slotOf({0, 0, 0}), BRICK_NONE);
    EXPECT_EQ(map.allocate({}), 0);
    const std::vector<Brick> bricks{{0, 0, 0}, {-1, -1, -1}, {0, 0, 0}, {7, -8, 9}, {-1, -1, -1}};
    EXPECT_EQ(map.allocate(bricks), 3);
    EXPECT_EQ(map.allocate(bricks), 0);
    EXPECT_EQ(map.brickCount(), 3);
    EXPECT_EQ(map.device().slotOf({0, 0, 0}), 0);
    EXPECT_EQ(map.device().slotOf({-1, -1, -1}), 1);
    EXPECT_EQ(map.device().slotOf({7, -8, 9}), 2);
    EXPECT_EQ(map.device().slotOf({7, -8, 8}), BRICK_NONE);
    expectEqualTables(compute, map, {{0, 0, 0}, {-1, -1, -1}, {7, -8, 9}});
  });
}

TEST(BrickMap, KeepsEntriesAndVoxels_WhenItGrows) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, 0.01F);
    const std::vector<Brick> first = randomBricks(1000, 40, 1);
    map.allocate(first);
    const int marked = map.brickCount();
    test::writeVoxels(
        compute, map,
        std::vector<test::HostVoxel>(static_cast<std::size_t>(marked) * BRICK_VOXELS, {-123, 45}));

    std::vector<Brick> all = first;
    for (unsigned batch = 0; batch < 6; ++batch) {
      const std::vector<Brick> more = randomBricks(8000, 2000, 10 + batch);
      map.allocate(more);
      all.insert(all.end(), more.begin(), more.end());
    }
    EXPECT_GT(map.brickCount(), 48000);
    EXPECT_GE(map.device().slotCapacity(), map.brickCount());
    EXPECT_EQ(map.pools().distances().size(),
              static_cast<std::size_t>(map.device().slotCapacity()) * BRICK_VOXELS);
    EXPECT_EQ(map.pools().weights().size(), map.pools().distances().size());
    EXPECT_EQ(map.pools().labels().size(), map.pools().distances().size());
    EXPECT_GT(map.device().bytes(), map.pools().distances().size() * VOXEL_BYTES);
    expectEqualTables(compute, map, all);

    const std::vector<test::HostVoxel> voxels = test::usedVoxels(compute, map);
    ASSERT_EQ(voxels.size(), static_cast<std::size_t>(map.brickCount()) * BRICK_VOXELS);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      const bool old = i < static_cast<std::size_t>(marked) * BRICK_VOXELS;
      ASSERT_EQ(voxels[i].distance, old ? -123 : 0) << i;
      ASSERT_EQ(voxels[i].weight, old ? 45 : 0) << i;
    }
  });
}

TEST(BrickMap, SupportsAll32BitCoordinates) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, 0.01F);
    constexpr int kLow = std::numeric_limits<int>::min();
    constexpr int kHigh = std::numeric_limits<int>::max();
    const std::vector<Brick> bricks{
        {kLow, kHigh, 0}, {kHigh, kLow, -1}, {0, 0, 0}, {1000000, -2000000, 3000000}};
    EXPECT_EQ(map.allocate(bricks), 4);
    expectEqualTables(compute, map, bricks);
  });
}

// True if any of 4^3 points of the brick projects into the image within the depth range.
bool isSeen(const Brick& brick, double size_m, const Eigen::Isometry3d& T_camera_world, const Intrinsics& K,
            double min_depth, double max_depth) {
  for (int i = 0; i < 64; ++i) {
    const Eigen::Vector3d offset = Eigen::Vector3d(i & 3, (i >> 2) & 3, i >> 4) / 3.0;
    const Eigen::Vector3d p = T_camera_world * (size_m * (brick.cast<double>() + offset));
    if (p.z() < min_depth || p.z() > max_depth) continue;
    const double u = K.fx * p.x() / p.z() + K.cx;
    const double v = K.fy * p.y() / p.z() + K.cy;
    if (u >= -0.5 && u <= K.width - 0.5 && v >= -0.5 && v <= K.height - 0.5) return true;
  }
  return false;
}

TEST(BrickMap, FindsEveryBrickInViewOnce) {
  test::onEachDevice([](ComputeContext& compute) {
    constexpr float kVoxel = 0.02F;
    constexpr double kBrick = 8 * 0.02F;
    BrickMap map(compute, kVoxel);
    map.allocate(randomBricks(20000, 40, 3));
    const Intrinsics K{290, 288, 150, 120, 317, 233};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-3, 3);
    for (int view = 0; view < 20; ++view) {
      const Eigen::Isometry3d T = test::lookAt({place(random), place(random), place(random)},
                                               {place(random), place(random), place(random)});
      const float max_depth = view == 0 ? 1000.0F : 4.0F;  // one view that is larger than the map
      const std::vector<cl_int> slots = slotsInView(map, T, K, 0.3F, max_depth);
      const std::set<cl_int> found(slots.begin(), slots.end());
      EXPECT_EQ(found.size(), slots.size()) << "a slot is listed twice";
      const Eigen::Isometry3d T_camera_world = T.inverse();
      for (int slot = 0; slot < map.brickCount(); ++slot) {
        if (isSeen(map.device().positionOf(slot), kBrick, T_camera_world, K, 0.3, max_depth)) {
          ASSERT_TRUE(found.contains(slot)) << map.device().positionOf(slot).transpose();
        }
      }
      // No brick lies farther outside the view than its own extent.
      for (const cl_int slot : slots) {
        const Eigen::Vector3d center = kBrick * (map.device().positionOf(slot).cast<double>().array() + 0.5);
        const double z = (T_camera_world * center).z();
        EXPECT_GT(z, 0.3 - kBrick);
        EXPECT_LT(z, max_depth + kBrick);
      }
    }
  });
}

TEST(BrickMap, SkipsInactiveBricks_UntilRequested) {
  test::onEachDevice([](ComputeContext& compute) {
    BrickMap map(compute, 0.01F);
    const std::vector<Brick> bricks{{0, 0, 10}, {1, 0, 10}, {0, 1, 10}};
    map.allocate(bricks);
    const Intrinsics K{100, 100, 50, 50, 100, 100};
    const auto inView = [&] { return slotsInView(map, Eigen::Isometry3d::Identity(), K, 0.1F, 2.0F); };
    const auto slotOnDevice = [&](const Brick& brick) {
      // These bricks lie in the second page of z, which is the only page (1).
      const std::size_t local =
          static_cast<std::size_t>(brick.x() + PAGE_SIDE * (brick.y() + PAGE_SIDE * (brick.z() - PAGE_SIDE)));
      return map.device().pageSlots().read(compute.queue())[PAGE_BRICKS + local];
    };
    ASSERT_THAT(inView(), testing::ElementsAre(0, 1, 2));
    ASSERT_EQ(slotOnDevice({1, 0, 10}), 1);

    map.deactivate(std::vector<Brick>{{1, 0, 10}});
    EXPECT_EQ(map.inactiveCount(), 1);
    EXPECT_THAT(inView(), testing::ElementsAre(0, 2));
    EXPECT_LT(slotOnDevice({1, 0, 10}), 0);
    EXPECT_EQ(slotOnDevice({0, 1, 10}), 2);
    EXPECT_EQ(map.device().slotOf({1, 0, 10}), 1);
    EXPECT_EQ(map.brickCount(), 3);

    // Active again in its old slot and at the same position in the page.
    EXPECT_EQ(map.allocate(bricks), 1);
    EXPECT_EQ(map.inactiveCount(), 0);
    EXPECT_THAT(inView(), testing::ElementsAre(0, 1, 2));
    EXPECT_EQ(slotOnDevice({1, 0, 10}), 1);
    EXPECT_EQ(map.allocate(bricks), 0);
  });
}

TEST(BrickMap, FindsTheSameBricks_FarFromTheOrigin) {
  test::onEachDevice([](ComputeContext& compute) {
    constexpr float kVoxel = 0.0078125F;  // a power of two: shifting by bricks is exact
    const std::vector<Brick> near_bricks = randomBricks(5000, 30, 7);
    const Brick shift(1 << 20, -(1 << 19), 123456);
    std::vector<Brick> far_bricks;
    for (const Brick& brick : near_bricks) far_bricks.push_back(brick + shift);
    BrickMap near_map(compute, kVoxel);
    BrickMap far_map(compute, kVoxel);
    near_map.allocate(near_bricks);
    far_map.allocate(far_bricks);
    const Intrinsics K{290, 288, 150, 120, 317, 233};
    const Eigen::Isometry3d T = test::lookAt({0.3, -0.2, -2.1}, {0.1, 0.2, 0.3});
    Eigen::Isometry3d T_far = T;
    T_far.translation() += shift.cast<double>() * (8.0 * static_cast<double>(kVoxel));
    std::vector<cl_int> a = slotsInView(near_map, T, K, 0.3F, 4.0F);
    std::vector<cl_int> b = slotsInView(far_map, T_far, K, 0.3F, 4.0F);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_GT(a.size(), 100U);
    EXPECT_EQ(a, b);
  });
}

}  // namespace
}  // namespace scantrove
