#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_budget.h"
#include "core/fusion/brick_index.h"
#include "core/fusion/brick_pages.h"
#include "core/fusion/brick_pools.h"
#include "core/fusion/brick_store.h"
#include "core/fusion/device_mirror.h"
#include "core/fusion/kernels/brick_layout.h"
#include "core/fusion/stored_page.h"

namespace scantrove {

/// Sorts by x, y, z. Kernels list bricks in the arbitrary order of their threads; sorting makes slots
/// reproducible.
void sortBricks(std::vector<Eigen::Vector3i>& bricks);

/// The directory and voxels of the map's 8^3 bricks. The directory is on the host and mirrored on the device
/// as a hash table (brick_layout.h); voxels with labels and colours are on the device. Only memory limits
/// extent and position. Slots are assigned 0, 1, 2, ..., and reused when free.
///
/// Beyond the device's budget, the pages that were out of view longest move to a file. They return unchanged
/// when a view meets them. Results for bricks in view are therefore equal, to the last bit, to those with
/// unlimited memory. The context's thread.
class BrickMap {
 public:
  BrickMap(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget = {});

  [[nodiscard]] float voxelSize() const { return voxel_size_m_; }
  /// All bricks, including inactive ones and those in the file.
  [[nodiscard]] int brickCount() const { return bricksHere() + stored_count_; }
  /// Bricks on the device.
  [[nodiscard]] int bricksHere() const { return static_cast<int>(positions_.size() - free_slots_.size()); }
  /// Slots that the pools have room for.
  [[nodiscard]] int slotCapacity() const { return pools_.capacity(); }
  /// One more than the highest slot ever assigned.
  [[nodiscard]] int slotEnd() const { return static_cast<int>(positions_.size()); }
  /// Device memory in use; of pools allocated at once, only the touched part.
  [[nodiscard]] std::size_t deviceBytes() const;
  /// Disk space in use.
  [[nodiscard]] std::uint64_t storedBytes() const { return store_.usedBytes(); }

  /// Slot of a brick; BRICK_NONE if it does not exist or is in the file.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const { return index_.slotOf(brick); }
  /// Position of the brick in `slot`.
  [[nodiscard]] const Eigen::Vector3i& positionOf(int slot) const;

  /// Starts a view that meets `pages`: loads those in the file. They stay until the next view.
  void beginFrame(std::span<const int> pages);

  /// Allocates those of `bricks` that do not exist (duplicates allowed) with weight 0 and no labels, on host
  /// and device; slots follow the order of `bricks`. Activates inactive ones. Returns the number of new and
  /// reactivated bricks.
  int allocate(std::span<const Eigen::Vector3i> bricks);

  /// Makes active `bricks` inactive: views and rays skip them at no cost. For bricks that contain only free
  /// space, allocated because of noise or an object that has gone. Keeps voxels and labels.
  void deactivate(std::span<const Eigen::Vector3i> bricks);
  [[nodiscard]] int inactiveCount() const { return inactive_count_; }

  /// Slots of all active bricks of these pages whose sphere meets the frustum. For the pages of
  /// BrickPages::pagesInView these are all bricks in view. The cost depends on the view, not the map.
  [[nodiscard]] std::vector<cl_int> slotsInPages(std::span<const int> pages,
                                                 const ViewFrustum& frustum) const;

  /// Pages ordered by position.
  [[nodiscard]] std::vector<int> pagesByPosition() const;
  /// All bricks of a page by local index, including inactive ones and those in the file.
  [[nodiscard]] std::vector<Eigen::Vector3i> bricksOfPage(int page) const;
  /// A copy of a page in the file; none if it is on the device or cannot be read.
  [[nodiscard]] std::optional<StoredPage> readStored(int page);
  /// A copy of a page on the device or in the file; none if it cannot be read.
  [[nodiscard]] std::optional<StoredPage> copyOfPage(int page);

  /// Adds a page of an earlier scan, from copyOfPage() of a map with the same voxel size. `position` is
  /// BrickPages::Page::position. None of its bricks may exist yet.
  void adopt(const Eigen::Vector3i& position, const StoredPage& stored);
  /// Number of the last view. Pages that it met have this number in BrickPages::Page::last_view and may have
  /// changed.
  [[nodiscard]] std::uint64_t view() const { return view_; }

  /// The error of writing or reading bricks since the last call. After the first failed write the map exceeds
  /// its budget.
  [[nodiscard]] std::optional<Error> takeFailure() { return std::exchange(failure_, std::nullopt); }

  [[nodiscard]] const Buffer<BrickEntry>& table() const { return table_.buffer(); }
  [[nodiscard]] cl_uint tableMask() const { return static_cast<cl_uint>(index_.entries().size() - 1); }
  /// slotCapacity() * BRICK_VOXELS of each (brick_layout.h).
  [[nodiscard]] Buffer<cl_short>& distances() { return pools_.distances(); }
  [[nodiscard]] const Buffer<cl_short>& distances() const { return pools_.distances(); }
  [[nodiscard]] Buffer<cl_uchar>& weights() { return pools_.weights(); }
  [[nodiscard]] const Buffer<cl_uchar>& weights() const { return pools_.weights(); }
  [[nodiscard]] Buffer<cl_uint>& labels() { return pools_.labels(); }
  [[nodiscard]] const Buffer<cl_uint>& labels() const { return pools_.labels(); }
  [[nodiscard]] Buffer<cl_uint>& colors() { return pools_.colors(); }
  [[nodiscard]] const Buffer<cl_uint>& colors() const { return pools_.colors(); }

  /// The same directory by pages (brick_page.h), for kernels that walk along rays.
  [[nodiscard]] const BrickPages& pages() const { return pages_; }
  [[nodiscard]] const Buffer<cl_int>& pageSlots() const { return page_slots_.buffer(); }

 private:
  /// Keeps the existing pages of `bricks` on the device until the next view.
  void holdPagesOf(std::span<const Eigen::Vector3i> bricks);
  void bringBack(std::span<const int> pages);
  /// Restores a page on the device.
  void putBack(int page, const StoredPage& stored);
  /// Writes a page to the file. False if that fails.
  bool putAway(int page, const StoredPage& stored);
  /// Makes room for `count` more bricks: moves pages to the file, and grows if that is not enough.
  void makeRoom(int count);
  /// Slots of a page on the device by local index, including inactive ones.
  [[nodiscard]] std::vector<int> slotsOfPage(int page) const;
  [[nodiscard]] StoredPage copyOfPageHere(int page) const;
  /// Moves a page to the file. False, without any change, if writing fails.
  bool sendAway(int page);
  void freeBrick(int slot);
  int takeSlot(const Eigen::Vector3i& brick);
  void forgetStored(int page);
  void reserve(int slots);
  /// Updates the device's directory from the host's.
  void updateDevice();

  ComputeContext& compute_;
  float voxel_size_m_;
  BrickBudget budget_;
  BrickIndex index_;
  BrickPages pages_;
  BrickPools pools_;
  BrickStore store_;
  bool may_store_;
  std::optional<Error> failure_;
  std::uint64_t view_ = 1;                  ///< number of the last view
  std::vector<Eigen::Vector3i> positions_;  ///< by slot
  std::vector<bool> inactive_;              ///< by slot
  std::priority_queue<int, std::vector<int>, std::greater<>> free_slots_;
  int inactive_count_ = 0;
  int stored_count_ = 0;
  std::vector<std::size_t> changed_entries_, changed_page_slots_;  ///< since the last updateDevice()
  DeviceMirror<BrickEntry> table_;
  DeviceMirror<cl_int> page_slots_;
};

}  // namespace scantrove
