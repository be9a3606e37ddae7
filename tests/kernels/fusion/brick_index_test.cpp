#include "core/fusion/brick_index.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

namespace scantrove {
namespace {

using Key = std::tuple<int, int, int>;

Eigen::Vector3i toBrick(const Key& key) { return {std::get<0>(key), std::get<1>(key), std::get<2>(key)}; }

// Bricks with hashes close together, so that they collide.
std::vector<Key> crowdedKeys(std::size_t capacity, std::size_t count) {
  std::vector<Key> keys;
  for (int x = 0; keys.size() < count; ++x) {
    if ((brick_hash(x, -7, 3) & (capacity - 1)) >= capacity - 8) keys.emplace_back(x, -7, 3);
  }
  return keys;
}

void insertAndEraseAtRandom(const std::vector<Key>& keys, unsigned seed, int steps) {
  BrickIndex index;
  std::map<Key, int> expected;
  // A copy that is updated only with the reported changes.
  std::vector<BrickEntry> mirror(index.entries().begin(), index.entries().end());
  std::mt19937 random(seed);
  for (int step = 0; step < steps; ++step) {
    const Key& key = keys[random() % keys.size()];
    std::vector<std::size_t> changed;
    if (expected.contains(key)) {
      index.erase(toBrick(key), changed);
      expected.erase(key);
    } else {
      changed.push_back(index.insert(toBrick(key), step));
      expected[key] = step;
    }
    if (mirror.size() != index.entries().size())
      mirror.assign(index.entries().begin(), index.entries().end());
    for (const std::size_t i : changed) mirror[i] = index.entries()[i];
    if (step % 97 != 0) continue;
    for (const Key& requested : keys) {
      const auto found = expected.find(requested);
      ASSERT_EQ(index.slotOf(toBrick(requested)), found == expected.end() ? BRICK_NONE : found->second);
    }
  }
  std::size_t used = 0;
  for (std::size_t i = 0; i < mirror.size(); ++i) {
    const BrickEntry& entry = index.entries()[i];
    ASSERT_EQ(mirror[i].slot, entry.slot) << "entry " << i << " changed without a report";
    if (entry.slot != BRICK_NONE) {
      ASSERT_EQ(Key(mirror[i].x, mirror[i].y, mirror[i].z), Key(entry.x, entry.y, entry.z));
    }
    used += entry.slot != BRICK_NONE ? 1U : 0U;
  }
  EXPECT_EQ(used, expected.size());
}

TEST(BrickIndex, EqualsAMap_AfterManyInsertionsAndDeletions) {
  std::vector<Key> keys;
  for (int i = 0; i < 3000; ++i) keys.emplace_back(i % 15 - 7, i / 15 % 20, i / 300 - 5);
  insertAndEraseAtRandom(keys, 1, 20000);
}

TEST(BrickIndex, HandlesCollisions_AcrossTheEndOfTheTable) {
  const std::size_t capacity = BrickIndex().entries().size();
  insertAndEraseAtRandom(crowdedKeys(capacity, 40), 2, 20000);
}

TEST(BrickIndex, KeepsEntries_WhenItGrowsAndShrinks) {
  BrickIndex index;
  std::vector<std::size_t> changed;
  for (int i = 0; i < 40000; ++i) index.insert({i, i % 7, -i}, i);
  for (int i = 0; i < 40000; i += 2) index.erase({i, i % 7, -i}, changed);
  for (int i = 0; i < 40000; ++i) {
    ASSERT_EQ(index.slotOf({i, i % 7, -i}), i % 2 == 0 ? BRICK_NONE : i);
  }
}

}  // namespace
}  // namespace scantrove
