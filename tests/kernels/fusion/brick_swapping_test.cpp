#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <tuple>

#include "core/fusion/brick_map.h"
#include "tests/support/each_device.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using Brick = Eigen::Vector3i;
using testing::HasSubstr;

constexpr int kBudget = 600;  // bricks
constexpr std::size_t kVoxels = BRICK_VOXELS;

struct ExpectedBrick {
  BrickContents stored = BrickContents(1);
  bool inactive = false;
};

struct PositionOrder {
  bool operator()(const Brick& a, const Brick& b) const {
    return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
  }
};

/// A map with a small budget, one with memory for all bricks, and the expected contents of both.
class TwoMaps {
 public:
  TwoMaps(ComputeContext& compute, const std::filesystem::path& folder, unsigned seed)
      : compute_(compute),
        small(compute, 0.01F, {kBudget, seed % 2 == 0, folder}),
        large(compute, 0.01F),
        random_(seed) {}

  /// Begins a frame of both maps with a random box of 2^3 pages in view.
  void beginRandomView() {
    const auto coordinate = [&] { return static_cast<int>(random_() % 7) - 3; };
    first_page_ = {coordinate(), coordinate(), coordinate()};
    small.beginFrame(inView(small));
    large.beginFrame(inView(large));
  }

  void change() {
    std::vector<Brick> requested;
    for (int i = 0; i < 30; ++i) {
      const auto offset = [&] { return static_cast<int>(random_() % (2 * PAGE_SIDE)); };
      requested.push_back(PAGE_SIDE * first_page_ + Brick(offset(), offset(), offset()));
      if (i % 5 == 0) requested.push_back(requested.back());
    }
    ASSERT_EQ(small.allocate(requested), large.allocate(requested));
    for (const Brick& brick : requested) {
      model[brick].inactive = false;
    }
    std::vector<Brick> deactivated;
    for (auto& [brick, expected] : model) {
      if (!isInView(brick)) continue;
      if (random_() % 3 == 0) write(brick, expected);
      if (!expected.inactive && random_() % 6 == 0) {
        expected.inactive = true;
        deactivated.push_back(brick);
      }
    }
    small.deactivate(deactivated);
    large.deactivate(deactivated);
  }

  /// Compares bricks in view, through the tables of kernels.
  void expectSameInView() {
    const std::vector<BrickEntry> table = small.device().table().read(compute_.queue());
    const std::vector<cl_int> page_slots = small.device().pageSlots().read(compute_.queue());
    const std::vector<cl_int> all_page_slots = large.device().pageSlots().read(compute_.queue());
    for (const auto& [brick, expected] : model) {
      if (!isInView(brick)) continue;
      const int slot = small.device().slotOf(brick);
      ASSERT_NE(slot, BRICK_NONE) << brick.transpose();
      ASSERT_EQ(lookUp(table, brick), slot);
      ASSERT_EQ(read(small, slot), expected.stored);
    }
    for (const int page : inView(small)) {
      const int block = small.pages().page(page).block;
      const int block_of_all = large.pages().page(page).block;
      ASSERT_EQ(block == PAGE_EMPTY, block_of_all == PAGE_EMPTY);
      for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
        const int slot_of_small = page_slots[static_cast<std::size_t>(block) * PAGE_BRICKS + i];
        const int slot_of_large = all_page_slots[static_cast<std::size_t>(block_of_all) * PAGE_BRICKS + i];
        ASSERT_EQ(std::min(slot_of_small, 0), std::min(slot_of_large, 0)) << "empty space differs";
        if (slot_of_small >= 0) {
          ASSERT_EQ(small.device().positionOf(slot_of_small), large.device().positionOf(slot_of_large));
        }
      }
    }
  }

  /// Compares all bricks.
  void expectAllEqual() {
    EXPECT_EQ(small.brickCount(), static_cast<int>(model.size()));
    EXPECT_EQ(small.inactiveCount(), large.inactiveCount());
    std::size_t found = 0;
    for (const int page : small.pagesByPosition()) {
      const std::vector<Brick> bricks = small.bricksOfPage(page);
      const auto stored = small.readStored(page);
      ASSERT_EQ(stored.has_value(), small.pages().page(page).bricksHere() == 0);
      const auto copy = small.copyOfPage(page);
      ASSERT_TRUE(copy);
      ASSERT_EQ(copy->bricks.count(), bricks.size());
      for (std::size_t i = 0; i < bricks.size(); ++i, ++found) {
        const ExpectedBrick& expected = model.at(bricks[i]);
        ASSERT_EQ(brickOf(copy->contents, i), expected.stored);
        ASSERT_EQ(copy->inactive[localBrick(bricks[i])], expected.inactive);
        if (!stored) {
          ASSERT_EQ(read(small, small.device().slotOf(bricks[i])), expected.stored);
          continue;
        }
        ASSERT_EQ(small.device().slotOf(bricks[i]), BRICK_NONE);
        ASSERT_EQ(brickOf(stored->contents, i), expected.stored);
        ASSERT_EQ(stored->inactive[localBrick(bricks[i])], expected.inactive);
      }
    }
    EXPECT_EQ(found, model.size());
  }

 private:
  ComputeContext& compute_;

 public:
  BrickMap small;
  BrickMap large;
  std::map<Brick, ExpectedBrick, PositionOrder> model;

 private:
  [[nodiscard]] bool isInView(const Brick& brick) const {
    const Brick local = brick - PAGE_SIDE * first_page_;
    return local.minCoeff() >= 0 && local.maxCoeff() < 2 * PAGE_SIDE;
  }

  [[nodiscard]] std::vector<int> inView(const BrickMap& map) const {
    std::vector<int> pages;
    for (int page = 1; page < map.pages().count(); ++page) {
      if (isInView(PAGE_SIDE * map.pages().page(page).position)) pages.push_back(page);
    }
    return pages;
  }

  void write(const Brick& brick, ExpectedBrick& expected) {
    BrickContents& stored = expected.stored;
    for (std::vector<cl_uint>* words : {&stored.labels, &stored.colors}) {
      for (cl_uint& word : *words) word = random_() % 2 == 0 ? 0 : static_cast<cl_uint>(random_());
    }
    for (std::size_t i = 0; i < kVoxels; ++i) {
      const bool is_seen = random_() % 2 == 0;
      const int distance = static_cast<int>(random_() % 65535) - DISTANCE_ONE;
      stored.distances[i] = static_cast<cl_short>(!is_seen ? DISTANCE_UNSEEN : distance == 0 ? 1 : distance);
      stored.weights[i] = static_cast<cl_uchar>(is_seen ? 1 + random_() % 255 : 0);
    }
    for (BrickMap* map : {&small, &large}) {
      const auto start = static_cast<std::size_t>(map->device().slotOf(brick)) * kVoxels;
      map->pools().distances().write(compute_.queue(), stored.distances, start);
      map->pools().weights().write(compute_.queue(), stored.weights, start);
      map->pools().labels().write(compute_.queue(), stored.labels, start);
      map->pools().colors().write(compute_.queue(), stored.colors, start);
    }
  }

  [[nodiscard]] BrickContents read(const BrickMap& map, int slot) const {
    const std::size_t start = static_cast<std::size_t>(slot) * kVoxels;
    BrickContents stored(1);
    map.pools().distances().read(compute_.queue(), std::span(stored.distances), start);
    map.pools().weights().read(compute_.queue(), std::span(stored.weights), start);
    map.pools().labels().read(compute_.queue(), std::span(stored.labels), start);
    map.pools().colors().read(compute_.queue(), std::span(stored.colors), start);
    return stored;
  }

  [[nodiscard]] static BrickContents brickOf(const BrickContents& all, std::size_t brick) {
    BrickContents one(1);
    const auto first = static_cast<std::ptrdiff_t>(brick * kVoxels);
    std::copy_n(all.distances.begin() + first, kVoxels, one.distances.begin());
    std::copy_n(all.weights.begin() + first, kVoxels, one.weights.begin());
    std::copy_n(all.labels.begin() + first, kVoxels, one.labels.begin());
    std::copy_n(all.colors.begin() + first, kVoxels, one.colors.begin());
    return one;
  }

  [[nodiscard]] int lookUp(const std::vector<BrickEntry>& table, const Brick& brick) const {
    const cl_uint mask = small.device().tableMask();
    cl_uint i = brick_hash(brick.x(), brick.y(), brick.z()) & mask;
    while (table[i].slot != BRICK_NONE && Brick(table[i].x, table[i].y, table[i].z) != brick)
      i = (i + 1) & mask;
    return table[i].slot;
  }

  std::mt19937 random_;
  Brick first_page_ = Brick::Zero();
};

TEST(BrickSwapping, EqualsAMapWithEnoughMemory) {
  test::onEachDevice([](ComputeContext& compute) {
    for (const unsigned seed : {1U, 2U}) {
      const test::TemporaryFolder folder;
      TwoMaps maps(compute, folder.path(), seed);
      std::uint64_t most_on_disk = 0;
      for (int view = 0; view < 150; ++view) {
        maps.beginRandomView();
        ASSERT_NO_FATAL_FAILURE(maps.expectSameInView());
        ASSERT_NO_FATAL_FAILURE(maps.change());
        ASSERT_NO_FATAL_FAILURE(maps.expectSameInView());
        if (view % 30 == 0) {
          ASSERT_NO_FATAL_FAILURE(maps.expectAllEqual());
        }
        most_on_disk = std::max(most_on_disk, maps.small.storedBytes());
      }
      maps.expectAllEqual();
      EXPECT_FALSE(maps.small.takeFailure());
      EXPECT_GT(maps.small.brickCount(), 4 * kBudget) << "the budget was never exceeded";
      EXPECT_GT(most_on_disk, 1000000U);
      // The bricks of a view of 8 pages fit into the budget.
      EXPECT_LE(maps.small.device().slotEnd(), kBudget);
      EXPECT_LT(maps.small.device().bytes(), maps.large.device().bytes() / 4);
    }
  });
}

/// Some 500 bricks along x, in 20 pages.
std::vector<Brick> row(int first, int last) {
  std::vector<Brick> bricks;
  for (int x = first; x < last; ++x) {
    for (int i = 0; i < 4; ++i) bricks.emplace_back(x, i % 2, i / 2);
  }
  return bricks;
}

void beginEmptyView(BrickMap& map) { map.beginFrame({}); }

TEST(BrickSwapping, ExceedsTheBudgetAndReportsItOnce_WithoutADisk) {
  test::onEachDevice([](ComputeContext& compute) {
    const test::TemporaryFolder folder;
    for (const bool at_once : {false, true}) {
      BrickMap map(compute, 0.01F, {kBudget, at_once, folder.path() / "nowhere"});
      map.allocate(row(0, 150));
      map.pools().labels().fill(compute.queue(), 77U, 0, static_cast<std::size_t>(kBudget) * kVoxels);
      EXPECT_FALSE(map.takeFailure());
      beginEmptyView(map);
      EXPECT_EQ(map.allocate(row(150, 400)), 1000);
      const auto failure = map.takeFailure();
      ASSERT_TRUE(failure);
      EXPECT_THAT(failure->message(), HasSubstr("nowhere"));
      EXPECT_THAT(failure->message(), HasSubstr("The scan goes on"));
      beginEmptyView(map);
      map.allocate(row(400, 600));
      EXPECT_FALSE(map.takeFailure());
      EXPECT_EQ(map.brickCount(), 2400);
      EXPECT_EQ(map.device().brickCount(), 2400);
      std::vector<cl_uint> labels(2400 * kVoxels);
      map.pools().labels().read(compute.queue(), std::span<cl_uint>(labels));
      for (std::size_t i = 0; i < labels.size(); ++i)
        ASSERT_EQ(labels[i], i < kBudget * kVoxels ? 77U : 0U) << i;
    }
  });
}

TEST(BrickSwapping, ExceedsTheBudget_WhenOneViewNeedsMore) {
  test::onEachDevice([](ComputeContext& compute) {
    const test::TemporaryFolder folder;
    BrickMap map(compute, 0.01F, {kBudget, compute.isCpu(), folder.path()});
    map.allocate(row(0, 400));
    EXPECT_EQ(map.device().brickCount(), 1600);
    EXPECT_GE(map.device().slotCapacity(), 1600);
    EXPECT_FALSE(map.takeFailure());
    EXPECT_EQ(map.storedBytes(), 0U);
    // Out of view, some bricks are swapped out for new ones.
    beginEmptyView(map);
    map.allocate(row(1000, 1010));
    EXPECT_EQ(map.device().slotEnd(), 1600);
    EXPECT_GT(map.storedBytes(), 0U);
    EXPECT_EQ(map.brickCount(), 1640);
  });
}

/// Opens the unlinked store file of `folder` again.
int openStoreIn(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code ignored;
    const std::filesystem::path target = std::filesystem::read_symlink(entry.path(), ignored);
    if (target.string().starts_with((folder / "scantrove-map-").string())) {
      return ::open(entry.path().c_str(), O_RDWR | O_CLOEXEC);
    }
  }
  return -1;
}

TEST(BrickSwapping, ReportsAndDropsAPage_WhenUnreadable) {
  test::onEachDevice([](ComputeContext& compute) {
    const test::TemporaryFolder folder;
    BrickMap map(compute, 0.01F, {kBudget, compute.isCpu(), folder.path()});
    map.allocate(row(0, 100));
    beginEmptyView(map);
    map.allocate(row(200, 260));
    ASSERT_EQ(map.device().slotOf({0, 0, 0}), BRICK_NONE);
    const int count = map.brickCount();
    const int file = openStoreIn(folder.path());
    ASSERT_GE(file, 0);
    ASSERT_EQ(::pwrite(file, "damaged", 7, 0), 7);
    ::close(file);

    map.beginFrame(std::vector<int>{map.pages().pageWith({0, 0, 0})});
    const auto failure = map.takeFailure();
    ASSERT_TRUE(failure);
    EXPECT_THAT(failure->message(), HasSubstr("cannot be read back"));
    EXPECT_EQ(map.brickCount(), count - 4 * PAGE_SIDE);
    EXPECT_EQ(map.device().slotOf({0, 0, 0}), BRICK_NONE);
    EXPECT_EQ(map.allocate(std::vector<Brick>{{0, 0, 0}}), 1) << "its position can be reused";
    EXPECT_NE(map.device().slotOf({0, 0, 0}), BRICK_NONE);
  });
}

}  // namespace
}  // namespace scantrove
