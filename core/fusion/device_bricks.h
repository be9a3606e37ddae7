#pragma once
#include <Eigen/Core>
#include <functional>
#include <queue>
#include <span>
#include <vector>

#include "core/compute/compute_context.h"
#include "core/fusion/brick_budget.h"
#include "core/fusion/brick_index.h"
#include "core/fusion/brick_pages.h"
#include "core/fusion/brick_pools.h"
#include "core/fusion/device_mirror.h"
#include "core/fusion/kernels/brick_layout.h"
#include "core/fusion/stored_page.h"

namespace scantrove {

/// A map's bricks on the device: their slots, directory and voxels. The directory is on the host and mirrored
/// on the device as a hash table (brick_layout.h) and by pages (brick_page.h). Slots are assigned 0, 1, 2,
/// ..., and reused when free. Kernels see changes of the directory after update(). The context's thread.
class DeviceBricks {
 public:
  DeviceBricks(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget);

  [[nodiscard]] float voxelSize() const { return voxel_size_m_; }
  [[nodiscard]] int brickCount() const { return slotEnd() - freeSlots(); }
  /// Slots that the pools have room for.
  [[nodiscard]] int slotCapacity() const { return pools_.capacity(); }
  /// One more than the highest slot ever assigned.
  [[nodiscard]] int slotEnd() const { return static_cast<int>(positions_.size()); }
  /// Slots below slotEnd() without a brick.
  [[nodiscard]] int freeSlots() const { return static_cast<int>(free_slots_.size()); }
  /// Further bricks within the budget.
  [[nodiscard]] int roomLeft() const;
  /// Device memory in use; of pools allocated at once, only the touched part.
  [[nodiscard]] std::size_t bytes() const;

  /// Slot of a brick; BRICK_NONE if it is not on the device.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const { return index_.slotOf(brick); }
  /// Position of the brick in `slot`.
  [[nodiscard]] const Eigen::Vector3i& positionOf(int slot) const;
  [[nodiscard]] bool isInactive(int slot) const { return inactive_[static_cast<std::size_t>(slot)]; }
  /// Slots of all active bricks of these pages whose sphere meets the frustum. For the pages of
  /// BrickPages::pagesInView these are all bricks in view. The cost depends on the view, not the map.
  [[nodiscard]] std::vector<cl_int> slotsInPages(std::span<const int> pages,
                                                 const ViewFrustum& frustum) const;

  /// Allocates slots below `slots`, beyond the budget if needed.
  void reserve(int slots);
  /// Adds bricks that do not exist, with weight 0 and no labels; slots follow the order of `bricks`.
  void add(std::span<const Eigen::Vector3i> bricks);
  void activate(const Eigen::Vector3i& brick, int slot);
  void deactivate(const Eigen::Vector3i& brick, int slot);

  [[nodiscard]] StoredPage copyOfPage(int page) const;
  void removePage(int page);
  /// Adds a removed or new page with its contents.
  void restorePage(int page, const StoredPage& stored);

  /// Updates the device's directory from the host's.
  void update();

  [[nodiscard]] const Buffer<BrickEntry>& table() const { return table_.buffer(); }
  [[nodiscard]] cl_uint tableMask() const { return static_cast<cl_uint>(index_.entries().size() - 1); }
  /// The same directory by pages, for kernels that walk along rays.
  [[nodiscard]] const Buffer<cl_int>& pageSlots() const { return page_slots_.buffer(); }
  [[nodiscard]] BrickPages& pages() { return pages_; }
  [[nodiscard]] const BrickPages& pages() const { return pages_; }
  [[nodiscard]] BrickPools& pools() { return pools_; }
  [[nodiscard]] const BrickPools& pools() const { return pools_; }

 private:
  int takeSlot(const Eigen::Vector3i& brick);
  void freeSlot(int slot);
  /// Slots of a page by local index, including inactive ones.
  [[nodiscard]] std::vector<int> slotsOfPage(int page) const;

  ComputeContext& compute_;
  float voxel_size_m_;
  BrickBudget budget_;
  BrickIndex index_;
  BrickPages pages_;
  BrickPools pools_;
  std::vector<Eigen::Vector3i> positions_;  ///< by slot
  std::vector<bool> inactive_;              ///< by slot
  std::priority_queue<int, std::vector<int>, std::greater<>> free_slots_;
  std::vector<std::size_t> changed_entries_, changed_page_slots_;  ///< since the last update()
  DeviceMirror<BrickEntry> table_;
  DeviceMirror<cl_int> page_slots_;
};

}  // namespace scantrove
