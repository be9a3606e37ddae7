// The part of BrickMap that moves pages of bricks to the file and back.
#include <algorithm>
#include <utility>

#include "core/base/check.h"
#include "core/fusion/brick_map.h"

namespace scantrove {

void BrickMap::makeRoom(int count) {
  const auto roomLeft = [&] {
    return static_cast<int>(free_slots_.size()) + std::max(0, budget_.bricks - slotEnd());
  };
  if (roomLeft() < count && may_store_) {
    std::vector<int> away;
    for (int page = 1; page < pages_.count(); ++page) {
      if (pages_.page(page).bricksHere() > 0 && pages_.page(page).last_view < view_) away.push_back(page);
    }
    // Among pages that left the view together, the older ones first, for a reproducible order.
    std::ranges::stable_sort(away, {}, [&](int page) { return pages_.page(page).last_view; });
    for (const int page : away) {
      if (roomLeft() >= count || !sendAway(page)) break;
    }
  }
  reserve(slotEnd() + std::max(0, count - static_cast<int>(free_slots_.size())));
}

std::vector<int> BrickMap::slotsOfPage(int index) const {
  const BrickPages::Page& page = pages_.page(index);
  std::vector<int> slots(page.slots);
  slots.insert(slots.end(), page.inactive.begin(), page.inactive.end());
  std::ranges::sort(slots, {}, [&](int slot) { return localBrick(positionOf(slot)); });
  return slots;
}

StoredPage BrickMap::copyOfPageHere(int index) const {
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

std::optional<StoredPage> BrickMap::copyOfPage(int index) {
  return pages_.page(index).record ? readStored(index) : copyOfPageHere(index);
}

bool BrickMap::putAway(int index, const StoredPage& stored) {
  Result<BrickStore::Record> record = store_.put(stored.toWords());
  if (!record) {
    failure_ = record.error();
    failure_->advice += " The scan goes on with all of its map in memory, beyond fusion.memory_budget_mb.";
    may_store_ = false;
    return false;
  }
  BrickPages::Page& page = pages_.page(index);
  page.record = *record;
  page.stored = stored.bricks;
  page.stored_inactive = static_cast<int>(stored.inactive.count());
  stored_count_ += static_cast<int>(stored.bricks.count());
  return true;
}

bool BrickMap::sendAway(int index) {
  const std::vector<int> slots = slotsOfPage(index);
  if (!putAway(index, copyOfPageHere(index))) return false;
  for (const int slot : slots) freeBrick(slot);
  pages_.takeOut(index);
  return true;
}

void BrickMap::adopt(const Eigen::Vector3i& position, const StoredPage& stored) {
  const int page = pages_.add(position);
  SCANTROVE_CHECK(pages_.page(page).bricksHere() == 0 && !pages_.page(page).record);
  if (stored.bricks.none()) return;
  inactive_count_ += static_cast<int>(stored.inactive.count());
  if (may_store_ && putAway(page, stored)) return;
  reserve(slotEnd() + static_cast<int>(stored.bricks.count()));
  putBack(page, stored);
  updateDevice();
}

void BrickMap::bringBack(std::span<const int> pages) {
  std::size_t count = 0;
  for (const int page : pages) count += pages_.page(page).stored.count();
  if (count == 0) return;
  makeRoom(static_cast<int>(count));
  for (const int page : pages) {
    const std::optional<StoredPage> stored = readStored(page);
    if (!stored) continue;
    forgetStored(page);
    putBack(page, *stored);
  }
}

std::optional<StoredPage> BrickMap::readStored(int index) {
  const BrickPages::Page& page = pages_.page(index);
  if (!page.record) return std::nullopt;
  const Result<std::vector<std::uint32_t>> words = store_.get(*page.record);
  if (words) return StoredPage::fromWords(*words);
  failure_ = words.error();
  inactive_count_ -= page.stored_inactive;
  forgetStored(index);
  return std::nullopt;
}

void BrickMap::forgetStored(int index) {
  BrickPages::Page& page = pages_.page(index);
  store_.erase(*page.record);
  stored_count_ -= static_cast<int>(page.stored.count());
  page.record.reset();
  page.stored.reset();
  page.stored_inactive = 0;
}

void BrickMap::putBack(int index, const StoredPage& stored) {
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

}  // namespace scantrove
