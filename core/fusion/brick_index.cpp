#include "core/fusion/brick_index.h"

#include <utility>

#include "core/base/check.h"

namespace scantrove {
namespace {
constexpr std::size_t kFirstCapacity = 1U << 12U;  // grows with the map
constexpr BrickEntry kFree{0, 0, 0, BRICK_NONE};
}  // namespace

BrickIndex::BrickIndex() : entries_(kFirstCapacity, kFree) {}

std::size_t BrickIndex::find(const Eigen::Vector3i& brick) const {
  const std::size_t mask = entries_.size() - 1;
  std::size_t i = brick_hash(brick.x(), brick.y(), brick.z()) & mask;
  while (entries_[i].slot != BRICK_NONE) {
    const BrickEntry& entry = entries_[i];
    if (entry.x == brick.x() && entry.y == brick.y() && entry.z == brick.z()) break;
    i = (i + 1) & mask;
  }
  return i;
}

int BrickIndex::slotOf(const Eigen::Vector3i& brick) const { return entries_[find(brick)].slot; }

std::size_t BrickIndex::insert(const Eigen::Vector3i& brick, int slot) {
  if (2 * (count_ + 1) > entries_.size()) grow();
  ++count_;
  return place({brick.x(), brick.y(), brick.z(), slot});
}

void BrickIndex::erase(const Eigen::Vector3i& brick, std::vector<std::size_t>& changed) {
  const std::size_t mask = entries_.size() - 1;
  std::size_t hole = find(brick);
  SCANTROVE_CHECK(entries_[hole].slot != BRICK_NONE);
  --count_;
  for (std::size_t i = (hole + 1) & mask; entries_[i].slot != BRICK_NONE; i = (i + 1) & mask) {
    const BrickEntry& entry = entries_[i];
    const std::size_t home = brick_hash(entry.x, entry.y, entry.z) & mask;
    // An entry may move to the hole if its search starts at or before the hole along the ring.
    if (((i - home) & mask) < ((i - hole) & mask)) continue;
    entries_[hole] = entry;
    changed.push_back(hole);
    hole = i;
  }
  entries_[hole] = kFree;
  changed.push_back(hole);
}

std::size_t BrickIndex::place(const BrickEntry& entry) {
  const std::size_t mask = entries_.size() - 1;
  std::size_t i = brick_hash(entry.x, entry.y, entry.z) & mask;
  while (entries_[i].slot != BRICK_NONE) i = (i + 1) & mask;
  entries_[i] = entry;
  return i;
}

void BrickIndex::grow() {
  const std::vector<BrickEntry> old =
      std::exchange(entries_, std::vector<BrickEntry>(2 * entries_.size(), kFree));
  for (const BrickEntry& entry : old) {
    if (entry.slot != BRICK_NONE) place(entry);
  }
}

}  // namespace scantrove
