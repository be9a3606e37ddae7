#include "core/fusion/brick_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kFirstSlots = 1 << 14;  // about one view of a room

bool comesBefore(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

void sortBricks(std::vector<Eigen::Vector3i>& bricks) { std::ranges::sort(bricks, comesBefore); }

BrickMap::BrickMap(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget)
    : compute_(compute),
      voxel_size_m_(voxel_size_m),
      budget_(budget),
      pools_(compute),
      store_(budget.folder),
      may_store_(!budget.folder.empty()) {
  SCANTROVE_CHECK(voxel_size_m > 0.0F);
  if (!budget_.at_once || !pools_.makeAtOnce(budget_.bricks)) {
    budget_.at_once = false;
    reserve(std::min(kFirstSlots, budget_.bricks));
  }
  updateDevice();
}

void BrickMap::reserve(int slots) {
  const int capacity = pools_.capacity();
  if (slots <= capacity) return;
  // Doubles up to the budget; beyond it grows by little more than needed.
  const int beyond = capacity + capacity / 8;
  pools_.grow(
      std::max(slots, 2 * capacity <= budget_.bricks ? 2 * capacity : std::max(budget_.bricks, beyond)),
      slotEnd());
  budget_.at_once = false;
}

std::size_t BrickMap::deviceBytes() const {
  const auto slots = static_cast<std::size_t>(budget_.at_once ? slotEnd() : slotCapacity());
  return slots * BRICK_VOXELS * VOXEL_BYTES + table_.buffer().size() * sizeof(BrickEntry) +
         page_slots_.buffer().size() * sizeof(cl_int);
}

const Eigen::Vector3i& BrickMap::positionOf(int slot) const {
  SCANTROVE_CHECK(slot >= 0 && slot < slotEnd());
  return positions_[static_cast<std::size_t>(slot)];
}

void BrickMap::beginFrame(std::span<const int> pages) {
  ++view_;
  for (const int page : pages) pages_.page(page).last_view = view_;
  bringBack(pages);
  updateDevice();
}

void BrickMap::holdPagesOf(std::span<const Eigen::Vector3i> bricks) {
  std::vector<int> held;
  for (const Eigen::Vector3i& brick : bricks) {
    const int page = pages_.pageWith(brick);
    if (page == BRICK_NONE) continue;
    pages_.page(page).last_view = view_;
    if (pages_.page(page).record) held.push_back(page);
  }
  bringBack(held);
}

int BrickMap::allocate(std::span<const Eigen::Vector3i> bricks) {
  holdPagesOf(bricks);
  std::vector<Eigen::Vector3i> fresh;
  std::unordered_set<Eigen::Vector3i, BrickHash> is_fresh;
  int woken = 0;
  for (const Eigen::Vector3i& brick : bricks) {
    const int known = index_.slotOf(brick);
    if (known == BRICK_NONE) {
      if (is_fresh.insert(brick).second) fresh.push_back(brick);
    } else if (inactive_[static_cast<std::size_t>(known)]) {
      inactive_[static_cast<std::size_t>(known)] = false;
      pages_.insert(brick, known, changed_page_slots_);
      ++woken;
    }
  }
  inactive_count_ -= woken;
  makeRoom(static_cast<int>(fresh.size()));
  std::vector<int> slots;
  for (const Eigen::Vector3i& brick : fresh) {
    slots.push_back(takeSlot(brick));
    pages_.insert(brick, slots.back(), changed_page_slots_);
    pages_.page(pages_.pageWith(brick)).last_view = view_;
  }
  pools_.clear(slots);
  updateDevice();
  return static_cast<int>(fresh.size()) + woken;
}

void BrickMap::deactivate(std::span<const Eigen::Vector3i> bricks) {
  holdPagesOf(bricks);
  for (const Eigen::Vector3i& brick : bricks) {
    const int slot = index_.slotOf(brick);
    if (slot == BRICK_NONE) continue;  // of a page that could not be read
    SCANTROVE_CHECK(!inactive_[static_cast<std::size_t>(slot)]);
    inactive_[static_cast<std::size_t>(slot)] = true;
    pages_.deactivate(brick, slot, changed_page_slots_);
    ++inactive_count_;
  }
  updateDevice();
}

int BrickMap::takeSlot(const Eigen::Vector3i& brick) {
  int slot = slotEnd();
  if (free_slots_.empty()) {
    positions_.push_back(brick);
    inactive_.push_back(false);
  } else {
    slot = free_slots_.top();
    free_slots_.pop();
    positions_[static_cast<std::size_t>(slot)] = brick;
    inactive_[static_cast<std::size_t>(slot)] = false;
  }
  changed_entries_.push_back(index_.insert(brick, slot));
  return slot;
}

void BrickMap::freeBrick(int slot) {
  index_.erase(positions_[static_cast<std::size_t>(slot)], changed_entries_);
  free_slots_.push(slot);
}

void BrickMap::updateDevice() {
  table_.update(compute_, index_.entries(), std::exchange(changed_entries_, {}));
  page_slots_.update(compute_, pages_.pageSlots(), std::exchange(changed_page_slots_, {}));
}

std::vector<cl_int> BrickMap::slotsInPages(std::span<const int> pages, const ViewFrustum& frustum) const {
  const double size_m = BRICK_SIDE * static_cast<double>(voxel_size_m_);
  const double radius_m = 0.5 * std::sqrt(3.0) * size_m;
  std::vector<cl_int> result;
  for (const int index : pages) {
    const BrickPages::Page& page = pages_.page(index);
    const Eigen::Vector3d center = (page.position.cast<double>().array() + 0.5) * (PAGE_SIDE * size_m);
    if (frustum.holdsSphere(center, PAGE_SIDE * radius_m)) {
      result.insert(result.end(), page.slots.begin(), page.slots.end());
      continue;
    }
    for (const int slot : page.slots) {
      const Eigen::Vector3d brick = (positionOf(slot).cast<double>().array() + 0.5) * size_m;
      if (frustum.intersectsSphere(brick, radius_m)) result.push_back(slot);
    }
  }
  return result;
}

std::vector<int> BrickMap::pagesByPosition() const {
  std::vector<int> pages(static_cast<std::size_t>(pages_.count() - 1));
  std::iota(pages.begin(), pages.end(), 1);
  std::ranges::sort(pages, comesBefore, [&](int page) { return pages_.page(page).position; });
  return pages;
}

std::vector<Eigen::Vector3i> BrickMap::bricksOfPage(int index) const {
  const BrickPages::Page& page = pages_.page(index);
  std::bitset<PAGE_BRICKS> bricks = page.stored;
  for (const std::vector<int>& slots : {page.slots, page.inactive}) {
    for (const int slot : slots) bricks.set(localBrick(positionOf(slot)));
  }
  std::vector<Eigen::Vector3i> result;
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    if (bricks[i]) result.push_back(brickOfPage(page, i));
  }
  return result;
}

}  // namespace scantrove
