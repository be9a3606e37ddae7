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

/// Sorts by x, y, z. Kernels list bricks in the order in which their threads happen to run; sorted, the same
/// scan gets the same slots.
void sortBricks(std::vector<Eigen::Vector3i>& bricks);

/// Which 8^3 bricks exist and where their voxels lie. The directory lives on the host and is mirrored on the
/// device as a hash table (brick_layout.h); voxels with their labels and colours live on the device. No limit
/// on extent or position other than memory. Slots are handed out 0, 1, 2, ..., and again when they are free.
///
/// Where the device's budget does not do, the pages that were out of view for longest go to a file, as they
/// are, and come back as soon as a view meets them: whatever asks about what lies in view gets the same
/// answers, to the last bit, as from a map with memory without end. One thread, the context's.
class BrickMap {
 public:
  BrickMap(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget = {});

  [[nodiscard]] float voxelSize() const { return voxel_size_m_; }
  /// All bricks: dormant ones too, and those in the file.
  [[nodiscard]] int brickCount() const { return bricksHere() + stored_count_; }
  /// Those on the device.
  [[nodiscard]] int bricksHere() const { return static_cast<int>(positions_.size() - free_slots_.size()); }
  /// Slots that the pools have room for.
  [[nodiscard]] int slotCapacity() const { return pools_.capacity(); }
  /// All slots that were ever handed out lie below.
  [[nodiscard]] int slotEnd() const { return static_cast<int>(positions_.size()); }
  /// Device memory in use: of pools that were made at once, as much as was touched.
  [[nodiscard]] std::size_t deviceBytes() const;
  /// Disk space in use.
  [[nodiscard]] std::uint64_t storedBytes() const { return store_.usedBytes(); }

  /// Slot of a brick or BRICK_NONE, also for those in the file.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const { return index_.slotOf(brick); }
  /// Position of the brick in `slot`.
  [[nodiscard]] const Eigen::Vector3i& positionOf(int slot) const;

  /// A view meets `pages`: brings back those in the file. They stay until the next view.
  void beginFrame(std::span<const int> pages);

  /// Allocates those of `bricks` that do not exist (duplicates welcome) with weight 0 and no labels, on host
  /// and device; slots follow the order of `bricks`. Wakes those that are dormant. Returns how many are new
  /// or awake again.
  int allocate(std::span<const Eigen::Vector3i> bricks);

  /// Lays `bricks` (awake ones) aside: views and rays pass them over as if there were none, and so cost
  /// nothing. For bricks that noise or a thing now gone once called for, and that hold nothing but free
  /// space. Voxels and labels stay as they are.
  void deactivate(std::span<const Eigen::Vector3i> bricks);
  [[nodiscard]] int inactiveCount() const { return inactive_count_; }

  /// Slots of all bricks (but dormant ones) of these pages whose sphere meets the frustum. With the pages
  /// that the frustum meets (BrickPages::pagesInView) these are all in view; cost follows the view, not the
  /// map.
  [[nodiscard]] std::vector<cl_int> slotsInPages(std::span<const int> pages,
                                                 const ViewFrustum& frustum) const;

  /// Pages in an order that only depends on where they are.
  [[nodiscard]] std::vector<int> pagesByPosition() const;
  /// All bricks of a page by local index, dormant ones and those in the file too.
  [[nodiscard]] std::vector<Eigen::Vector3i> bricksOfPage(int page) const;
  /// What a page in the file holds, which stays there; nothing for one on the device, or if it cannot be
  /// read.
  [[nodiscard]] std::optional<StoredPage> readStored(int page);
  /// What a page holds, wherever it is; it stays there. Nothing if it cannot be read.
  [[nodiscard]] std::optional<StoredPage> copyOfPage(int page);

  /// A page as copyOfPage() gave it, at BrickPages::Page::position, of a map of the same voxels: to begin
  /// with what an earlier scan found. There is no brick of it yet.
  void adopt(const Eigen::Vector3i& position, const StoredPage& stored);
  /// Number of the last view: pages that it met have it in BrickPages::Page::last_view, and may have changed.
  [[nodiscard]] std::uint64_t view() const { return view_; }

  /// Why bricks could not be written, or not be read back, since the last call. After the first write that
  /// fails the map goes on beyond its budget.
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
  /// Pages of `bricks`, as far as there are any: on the device until the next view.
  void holdPagesOf(std::span<const Eigen::Vector3i> bricks);
  void bringBack(std::span<const int> pages);
  /// What a page held, on the device again.
  void putBack(int page, const StoredPage& stored);
  /// What a page held is in the file. False: it could not be written.
  bool putAway(int page, const StoredPage& stored);
  /// Makes room for `count` more bricks: sends pages away, and grows where that is not enough.
  void makeRoom(int count);
  /// Of a page on the device, dormant ones too, by local index.
  [[nodiscard]] std::vector<int> slotsOfPage(int page) const;
  [[nodiscard]] StoredPage copyOfPageHere(int page) const;
  /// False: it could not be written, and nothing changed.
  bool sendAway(int page);
  void freeBrick(int slot);
  int takeSlot(const Eigen::Vector3i& brick);
  void forgetStored(int page);
  void reserve(int slots);
  /// Makes the device's directory that of the host.
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
  std::vector<std::size_t> changed_entries_, changed_page_slots_;  ///< since the device last heard
  DeviceMirror<BrickEntry> table_;
  DeviceMirror<cl_int> page_slots_;
};

}  // namespace scantrove
