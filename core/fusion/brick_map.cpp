#include "core/fusion/brick_map.h"

#include <algorithm>
#include <bitset>
#include <numeric>
#include <unordered_set>

#include "core/base/check.h"
#include "core/geometry/position_order.h"

namespace scantrove {

void sortBricks(std::vector<Eigen::Vector3i>& bricks) { std::ranges::sort(bricks, PositionOrder{}); }

BrickMap::BrickMap(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget)
    : device_(compute, voxel_size_m, budget), store_(budget.folder), may_store_(!budget.folder.empty()) {}

void BrickMap::beginFrame(std::span<const int> pages) {
  ++view_;
  for (const int page : pages) device_.pages().page(page).last_view = view_;
  bringBack(pages);
  device_.update();
}

void BrickMap::holdPagesOf(std::span<const Eigen::Vector3i> bricks) {
  std::vector<int> held;
  for (const Eigen::Vector3i& brick : bricks) {
    const int index = pages().pageWith(brick);
    if (index == BRICK_NONE) continue;
    BrickPages::Page& page = device_.pages().page(index);
    page.last_view = view_;
    if (page.record) held.push_back(index);
  }
  bringBack(held);
}

int BrickMap::allocate(std::span<const Eigen::Vector3i> bricks) {
  holdPagesOf(bricks);
  std::vector<Eigen::Vector3i> fresh;
  std::unordered_set<Eigen::Vector3i, BrickHash> is_fresh;
  int woken = 0;
  for (const Eigen::Vector3i& brick : bricks) {
    const int known = device_.slotOf(brick);
    if (known == BRICK_NONE) {
      if (is_fresh.insert(brick).second) fresh.push_back(brick);
    } else if (device_.isInactive(known)) {
      device_.activate(brick, known);
      ++woken;
    }
  }
  inactive_count_ -= woken;
  makeRoom(static_cast<int>(fresh.size()));
  device_.add(fresh);
  for (const Eigen::Vector3i& brick : fresh) device_.pages().page(pages().pageWith(brick)).last_view = view_;
  device_.update();
  return static_cast<int>(fresh.size()) + woken;
}

void BrickMap::deactivate(std::span<const Eigen::Vector3i> bricks) {
  holdPagesOf(bricks);
  for (const Eigen::Vector3i& brick : bricks) {
    const int slot = device_.slotOf(brick);
    if (slot == BRICK_NONE) continue;  // of a page that could not be read
    device_.deactivate(brick, slot);
    ++inactive_count_;
  }
  device_.update();
}

std::vector<int> BrickMap::pagesByPosition() const {
  std::vector<int> all(static_cast<std::size_t>(pages().count() - 1));
  std::iota(all.begin(), all.end(), 1);
  std::ranges::sort(all, PositionOrder{}, [&](int page) { return pages().page(page).position; });
  return all;
}

std::vector<Eigen::Vector3i> BrickMap::bricksOfPage(int index) const {
  const BrickPages::Page& page = pages().page(index);
  std::bitset<PAGE_BRICKS> bricks = page.stored;
  for (const std::vector<int>& slots : {page.slots, page.inactive}) {
    for (const int slot : slots) bricks.set(localBrick(device_.positionOf(slot)));
  }
  std::vector<Eigen::Vector3i> result;
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    if (bricks[i]) result.push_back(brickOfPage(page, i));
  }
  return result;
}

std::optional<StoredPage> BrickMap::readStored(int index) {
  const BrickPages::Page& page = pages().page(index);
  if (!page.record) return std::nullopt;
  const Result<std::vector<std::uint32_t>> words = store_.get(*page.record);
  if (words) return StoredPage::fromWords(*words);
  failure_ = words.error();
  inactive_count_ -= page.stored_inactive;
  forgetStored(index);
  return std::nullopt;
}

std::optional<StoredPage> BrickMap::copyOfPage(int index) {
  return pages().page(index).record ? readStored(index) : device_.copyOfPage(index);
}

void BrickMap::adopt(const Eigen::Vector3i& position, const StoredPage& stored) {
  const int page = device_.pages().add(position);
  SCANTROVE_CHECK(pages().page(page).bricksHere() == 0 && !pages().page(page).record);
  if (stored.bricks.none()) return;
  inactive_count_ += static_cast<int>(stored.inactive.count());
  if (may_store_ && putAway(page, stored)) return;
  device_.reserve(device_.slotEnd() + static_cast<int>(stored.bricks.count()));
  device_.restorePage(page, stored);
  device_.update();
}

void BrickMap::makeRoom(int count) {
  if (device_.roomLeft() < count && may_store_) {
    std::vector<int> away;
    for (int page = 1; page < pages().count(); ++page) {
      if (pages().page(page).bricksHere() > 0 && pages().page(page).last_view < view_) away.push_back(page);
    }
    // Among pages that left the view together, the older ones first, for a reproducible order.
    std::ranges::stable_sort(away, {}, [&](int page) { return pages().page(page).last_view; });
    for (const int page : away) {
      if (device_.roomLeft() >= count || !sendAway(page)) break;
    }
  }
  device_.reserve(device_.slotEnd() + std::max(0, count - device_.freeSlots()));
}

void BrickMap::bringBack(std::span<const int> pages) {
  std::size_t count = 0;
  for (const int page : pages) count += device_.pages().page(page).stored.count();
  if (count == 0) return;
  makeRoom(static_cast<int>(count));
  for (const int page : pages) {
    const std::optional<StoredPage> stored = readStored(page);
    if (!stored) continue;
    forgetStored(page);
    device_.restorePage(page, *stored);
  }
}

bool BrickMap::sendAway(int page) {
  if (!putAway(page, device_.copyOfPage(page))) return false;
  device_.removePage(page);
  return true;
}

bool BrickMap::putAway(int index, const StoredPage& stored) {
  Result<BrickStore::Record> record = store_.put(stored.toWords());
  if (!record) {
    failure_ = record.error();
    failure_->advice += " The scan goes on with all of its map in memory, beyond fusion.memory_budget_mb.";
    may_store_ = false;
    return false;
  }
  BrickPages::Page& page = device_.pages().page(index);
  page.record = *record;
  page.stored = stored.bricks;
  page.stored_inactive = static_cast<int>(stored.inactive.count());
  stored_count_ += static_cast<int>(stored.bricks.count());
  return true;
}

void BrickMap::forgetStored(int index) {
  BrickPages::Page& page = device_.pages().page(index);
  store_.erase(*page.record);
  stored_count_ -= static_cast<int>(page.stored.count());
  page.record.reset();
  page.stored.reset();
  page.stored_inactive = 0;
}

}  // namespace scantrove
