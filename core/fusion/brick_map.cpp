#include "core/fusion/brick_map.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace scantrove {
namespace {
constexpr int kFirstSlots = 1 << 14;
constexpr std::size_t kVoxels = BRICK_VOXELS;
}  // namespace

void sortBricks(std::vector<Eigen::Vector3i>& bricks) {
  std::sort(bricks.begin(), bricks.end(), [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
}

BrickMap::BrickMap(ComputeContext& compute, float voxel_size_m)
    : compute_(compute), voxel_size_m_(voxel_size_m) {
  SCANTROVE_CHECK(voxel_size_m > 0.0F);
  reserve(kFirstSlots);
  table_.update(compute, index_.entries(), {});
  page_slots_.update(compute, pages_.pageSlots(), {});
}

// Voxels of slots that are not handed out yet are never read and need no value.
void BrickMap::reserve(int slots) {
  if (slots <= slot_capacity_) return;
  int capacity = std::max(slot_capacity_, kFirstSlots);
  while (capacity < slots) capacity *= 2;
  Buffer<TsdfVoxel> larger(compute_.context(), static_cast<std::size_t>(capacity) * kVoxels);
  const std::size_t used = positions_.size() * kVoxels * sizeof(TsdfVoxel);
  if (used > 0) {
    compute_.queue().enqueueCopyBuffer(voxels_.cl(), larger.cl(), 0, 0, used);
    compute_.finish();
  }
  voxels_ = larger;
  slot_capacity_ = capacity;
}

std::size_t BrickMap::deviceBytes() const {
  return voxels_.size() * sizeof(TsdfVoxel) + table_.buffer().size() * sizeof(BrickEntry) +
         page_slots_.buffer().size() * sizeof(cl_int);
}

const Eigen::Vector3i& BrickMap::positionOf(int slot) const {
  SCANTROVE_CHECK(slot >= 0 && slot < brickCount());
  return positions_[static_cast<std::size_t>(slot)];
}

int BrickMap::allocate(std::span<const Eigen::Vector3i> bricks) {
  const int old_count = brickCount();
  std::vector<std::size_t> changed_entries;
  std::vector<std::size_t> changed_page_slots;
  std::vector<Eigen::Vector3i> fresh;
  int woken = 0;
  for (const Eigen::Vector3i& brick : bricks) {
    if (const int known = index_.slotOf(brick); known != BRICK_NONE) {
      if (known < old_count && dormant_[static_cast<std::size_t>(known)]) {
        dormant_[static_cast<std::size_t>(known)] = false;
        pages_.insert(brick, known, changed_page_slots);
        ++woken;
      }
      continue;
    }
    const int slot = old_count + static_cast<int>(fresh.size());
    changed_entries.push_back(index_.insert(brick, slot));
    pages_.insert(brick, slot, changed_page_slots);
    fresh.push_back(brick);
  }
  dormant_count_ -= woken;
  if (fresh.empty() && woken == 0) return 0;
  const int count = static_cast<int>(fresh.size());
  reserve(old_count + count);
  positions_.insert(positions_.end(), fresh.begin(), fresh.end());
  dormant_.resize(positions_.size(), false);
  if (count > 0)
    voxels_.fill(compute_.queue(), TsdfVoxel{0, 0}, static_cast<std::size_t>(old_count) * kVoxels,
                 static_cast<std::size_t>(count) * kVoxels);
  table_.update(compute_, index_.entries(), changed_entries);
  page_slots_.update(compute_, pages_.pageSlots(), changed_page_slots);
  return count + woken;
}

void BrickMap::makeDormant(std::span<const cl_int> slots) {
  if (slots.empty()) return;
  std::vector<std::size_t> changed;
  for (const cl_int slot : slots) {
    SCANTROVE_CHECK(slot >= 0 && slot < brickCount() && !dormant_[static_cast<std::size_t>(slot)]);
    dormant_[static_cast<std::size_t>(slot)] = true;
    pages_.remove(positionOf(slot), slot, changed);
  }
  dormant_count_ += static_cast<int>(slots.size());
  page_slots_.update(compute_, pages_.pageSlots(), changed);
}

std::vector<cl_int> BrickMap::slotsInPages(std::span<const int> pages, const ViewFrustum& frustum) const {
  const double size_m = BRICK_SIDE * static_cast<double>(voxel_size_m_);
  const double radius_m = 0.5 * std::sqrt(3.0) * size_m;
  std::vector<cl_int> result;
  for (const int index : pages) {
    const BrickPages::Page& page = pages_.page(index);
    const Eigen::Vector3d centre = (page.position.cast<double>().array() + 0.5) * (PAGE_SIDE * size_m);
    if (frustum.holdsSphere(centre, PAGE_SIDE * radius_m)) {
      result.insert(result.end(), page.slots.begin(), page.slots.end());
      continue;
    }
    for (const int slot : page.slots) {
      const Eigen::Vector3d brick = (positionOf(slot).cast<double>().array() + 0.5) * size_m;
      if (frustum.meetsSphere(brick, radius_m)) result.push_back(slot);
    }
  }
  return result;
}

}  // namespace scantrove
