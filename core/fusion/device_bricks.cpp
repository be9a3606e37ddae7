#include "core/fusion/device_bricks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kFirstSlots = 1 << 14;  // about one view of a room

}  // namespace

DeviceBricks::DeviceBricks(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget)
    : compute_(compute), voxel_size_m_(voxel_size_m), budget_(budget), pools_(compute) {
  SCANTROVE_CHECK(voxel_size_m > 0.0F);
  if (!budget_.at_once || !pools_.makeAtOnce(budget_.bricks)) {
    budget_.at_once = false;
    reserve(std::min(kFirstSlots, budget_.bricks));
  }
  update();
}

int DeviceBricks::roomLeft() const { return freeSlots() + std::max(0, budget_.bricks - slotEnd()); }

void DeviceBricks::reserve(int slots) {
  const int capacity = pools_.capacity();
  if (slots <= capacity) return;
  // Doubles up to the budget; beyond it grows by little more than needed.
  const int beyond = capacity + capacity / 8;
  pools_.grow(
      std::max(slots, 2 * capacity <= budget_.bricks ? 2 * capacity : std::max(budget_.bricks, beyond)),
      slotEnd());
  budget_.at_once = false;
}

std::size_t DeviceBricks::bytes() const {
  const auto slots = static_cast<std::size_t>(budget_.at_once ? slotEnd() : slotCapacity());
  return slots * BRICK_VOXELS * VOXEL_BYTES + table_.buffer().size() * sizeof(BrickEntry) +
         page_slots_.buffer().size() * sizeof(cl_int);
}

const Eigen::Vector3i& DeviceBricks::positionOf(int slot) const {
  SCANTROVE_CHECK(slot >= 0 && slot < slotEnd());
  return positions_[static_cast<std::size_t>(slot)];
}

std::vector<cl_int> DeviceBricks::slotsInPages(std::span<const int> pages, const ViewFrustum& frustum) const {
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

void DeviceBricks::add(std::span<const Eigen::Vector3i> bricks) {
  std::vector<int> slots;
  for (const Eigen::Vector3i& brick : bricks) {
    slots.push_back(takeSlot(brick));
    pages_.insert(brick, slots.back(), changed_page_slots_);
  }
  pools_.clear(slots);
}

void DeviceBricks::activate(const Eigen::Vector3i& brick, int slot) {
  inactive_[static_cast<std::size_t>(slot)] = false;
  pages_.insert(brick, slot, changed_page_slots_);
}

void DeviceBricks::deactivate(const Eigen::Vector3i& brick, int slot) {
  SCANTROVE_CHECK(!isInactive(slot));
  inactive_[static_cast<std::size_t>(slot)] = true;
  pages_.deactivate(brick, slot, changed_page_slots_);
}

std::vector<int> DeviceBricks::slotsOfPage(int index) const {
  const BrickPages::Page& page = pages_.page(index);
  std::vector<int> slots(page.slots);
  slots.insert(slots.end(), page.inactive.begin(), page.inactive.end());
  std::ranges::sort(slots, {}, [&](int slot) { return localBrick(positionOf(slot)); });
  return slots;
}

StoredPage DeviceBricks::copyOfPage(int index) const {
  const BrickPages::Page& page = pages_.page(index);
  const std::vector<int> slots = slotsOfPage(index);
  StoredPage copy;
  for (const int slot : slots) copy.bricks.set(localBrick(positionOf(slot)));
  for (const int slot : page.inactive) copy.inactive.set(localBrick(positionOf(slot)));
  copy.contents = pools_.read(slots);
  const auto block =
      pages_.pageSlots().subspan(static_cast<std::size_t>(page.block) * PAGE_BRICKS, PAGE_BRICKS);
  std::ranges::transform(block, copy.cells.begin(),
                         [](int cell) { return static_cast<std::int8_t>(std::min(cell, 0)); });
  return copy;
}

void DeviceBricks::removePage(int index) {
  for (const int slot : slotsOfPage(index)) freeSlot(slot);
  pages_.takeOut(index);
}

void DeviceBricks::restorePage(int index, const StoredPage& stored) {
  const BrickPages::Page& page = pages_.page(index);
  BrickPages::Cells cells{};
  std::ranges::copy(stored.cells, cells.begin());
  std::vector<int> slots;
  std::vector<int> inactive;
  for (std::size_t i = 0; i < PAGE_BRICKS; ++i) {
    if (!stored.bricks[i]) continue;
    const int slot = takeSlot(brickOfPage(page, i));
    slots.push_back(slot);
    if (stored.inactive[i]) {
      inactive_[static_cast<std::size_t>(slot)] = true;
      inactive.push_back(slot);
    } else {
      cells[i] = slot;
    }
  }
  pools_.write(slots, stored.contents);
  pages_.putBack(index, cells, std::move(inactive), changed_page_slots_);
}

int DeviceBricks::takeSlot(const Eigen::Vector3i& brick) {
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

void DeviceBricks::freeSlot(int slot) {
  index_.erase(positions_[static_cast<std::size_t>(slot)], changed_entries_);
  free_slots_.push(slot);
}

void DeviceBricks::update() {
  table_.update(compute_, index_.entries(), std::exchange(changed_entries_, {}));
  page_slots_.update(compute_, pages_.pageSlots(), std::exchange(changed_page_slots_, {}));
}

}  // namespace scantrove
