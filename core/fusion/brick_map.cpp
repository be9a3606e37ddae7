#include "core/fusion/brick_map.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/fusion/brick_index.h"
#include "core/fusion/device_mirror.h"

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

struct BrickMap::Directory {
  Directory(ComputeContext& context, float voxel_size) : compute(context), voxel_size_m(voxel_size) {}

  ComputeContext& compute;
  float voxel_size_m;

  BrickIndex index;
  BrickPages pages;
  std::vector<Eigen::Vector3i> positions;
  std::vector<bool> dormant;  ///< by slot
  int dormant_count = 0;
  DeviceMirror<BrickEntry> table;
  DeviceMirror<cl_int> page_slots;
  Buffer<TsdfVoxel> voxels;
  int slot_capacity = 0;

  [[nodiscard]] double brickSize() const { return BRICK_SIDE * static_cast<double>(voxel_size_m); }

  // Voxels of slots that are not handed out yet are never read and need no value.
  void reserve(int slots) {
    if (slots <= slot_capacity) return;
    int capacity = std::max(slot_capacity, kFirstSlots);
    while (capacity < slots) capacity *= 2;
    Buffer<TsdfVoxel> larger(compute.context(), static_cast<std::size_t>(capacity) * kVoxels);
    const std::size_t used = positions.size() * kVoxels * sizeof(TsdfVoxel);
    if (used > 0) {
      compute.queue().enqueueCopyBuffer(voxels.cl(), larger.cl(), 0, 0, used);
      compute.finish();
    }
    voxels = larger;
    slot_capacity = capacity;
  }
};

BrickMap::BrickMap(ComputeContext& compute, float voxel_size_m)
    : directory_(std::make_unique<Directory>(compute, voxel_size_m)) {
  SCANTROVE_CHECK(voxel_size_m > 0.0F);
  directory_->reserve(kFirstSlots);
  directory_->table.update(compute, directory_->index.entries(), {});
  directory_->page_slots.update(compute, directory_->pages.pageSlots(), {});
}

BrickMap::~BrickMap() = default;

float BrickMap::voxelSize() const { return directory_->voxel_size_m; }
int BrickMap::brickCount() const { return static_cast<int>(directory_->positions.size()); }
int BrickMap::slotCapacity() const { return directory_->slot_capacity; }

std::size_t BrickMap::deviceBytes() const {
  return directory_->voxels.size() * sizeof(TsdfVoxel) +
         directory_->table.buffer().size() * sizeof(BrickEntry) +
         directory_->page_slots.buffer().size() * sizeof(cl_int);
}

int BrickMap::slotOf(const Eigen::Vector3i& brick) const { return directory_->index.slotOf(brick); }

const Eigen::Vector3i& BrickMap::positionOf(int slot) const {
  SCANTROVE_CHECK(slot >= 0 && slot < brickCount());
  return directory_->positions[static_cast<std::size_t>(slot)];
}

int BrickMap::allocate(std::span<const Eigen::Vector3i> bricks) {
  Directory& d = *directory_;
  const int old_count = brickCount();
  std::vector<std::size_t> changed_entries;
  std::vector<std::size_t> changed_page_slots;
  std::vector<Eigen::Vector3i> fresh;
  int woken = 0;
  for (const Eigen::Vector3i& brick : bricks) {
    if (const int known = d.index.slotOf(brick); known != BRICK_NONE) {
      if (known < old_count && d.dormant[static_cast<std::size_t>(known)]) {
        d.dormant[static_cast<std::size_t>(known)] = false;
        d.pages.insert(brick, known, changed_page_slots);
        ++woken;
      }
      continue;
    }
    const int slot = old_count + static_cast<int>(fresh.size());
    changed_entries.push_back(d.index.insert(brick, slot));
    d.pages.insert(brick, slot, changed_page_slots);
    fresh.push_back(brick);
  }
  d.dormant_count -= woken;
  if (fresh.empty() && woken == 0) return 0;
  const int count = static_cast<int>(fresh.size());
  d.reserve(old_count + count);
  d.positions.insert(d.positions.end(), fresh.begin(), fresh.end());
  d.dormant.resize(d.positions.size(), false);
  if (count > 0)
    d.voxels.fill(d.compute.queue(), TsdfVoxel{0, 0}, static_cast<std::size_t>(old_count) * kVoxels,
                  static_cast<std::size_t>(count) * kVoxels);
  d.table.update(d.compute, d.index.entries(), changed_entries);
  d.page_slots.update(d.compute, d.pages.pageSlots(), changed_page_slots);
  return count + woken;
}

void BrickMap::makeDormant(std::span<const cl_int> slots) {
  if (slots.empty()) return;
  Directory& d = *directory_;
  std::vector<std::size_t> changed;
  for (const cl_int slot : slots) {
    SCANTROVE_CHECK(slot >= 0 && slot < brickCount() && !d.dormant[static_cast<std::size_t>(slot)]);
    d.dormant[static_cast<std::size_t>(slot)] = true;
    d.pages.remove(positionOf(slot), slot, changed);
  }
  d.dormant_count += static_cast<int>(slots.size());
  d.page_slots.update(d.compute, d.pages.pageSlots(), changed);
}

int BrickMap::dormantCount() const { return directory_->dormant_count; }

std::vector<cl_int> BrickMap::slotsInView(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K,
                                          float min_depth_m, float max_depth_m) const {
  const ViewFrustum frustum(T_world_camera, K, min_depth_m, max_depth_m);
  return slotsInPages(directory_->pages.pagesInView(frustum, directory_->brickSize()), frustum);
}

std::vector<cl_int> BrickMap::slotsInPages(std::span<const int> pages, const ViewFrustum& frustum) const {
  const double size_m = directory_->brickSize();
  const double radius_m = 0.5 * std::sqrt(3.0) * size_m;
  std::vector<cl_int> result;
  for (const int index : pages) {
    const BrickPages::Page& page = directory_->pages.page(index);
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

const Buffer<BrickEntry>& BrickMap::table() const { return directory_->table.buffer(); }
cl_uint BrickMap::tableMask() const { return static_cast<cl_uint>(directory_->index.entries().size() - 1); }
Buffer<TsdfVoxel>& BrickMap::voxels() { return directory_->voxels; }
const Buffer<TsdfVoxel>& BrickMap::voxels() const { return directory_->voxels; }
const BrickPages& BrickMap::pages() const { return directory_->pages; }
const Buffer<cl_int>& BrickMap::pageSlots() const { return directory_->page_slots.buffer(); }

}  // namespace scantrove
