#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_index.h"
#include "core/fusion/brick_pages.h"
#include "core/fusion/device_mirror.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// Sorts by x, y, z. Kernels list bricks in the order in which their threads happen to run; sorted, the same
/// scan gets the same slots.
void sortBricks(std::vector<Eigen::Vector3i>& bricks);

/// Which 8^3 bricks exist and where their voxels lie. The directory lives on the host and is mirrored on the
/// device as a hash table (brick_layout.h); voxels live on the device only. No limit on extent or position
/// other than memory: table and pools grow. Slots are handed out 0, 1, 2, ... One thread, the context's.
class BrickMap {
 public:
  BrickMap(ComputeContext& compute, float voxel_size_m);

  [[nodiscard]] float voxelSize() const { return voxel_size_m_; }
  /// Allocated bricks = used slots, dormant ones too.
  [[nodiscard]] int brickCount() const { return static_cast<int>(positions_.size()); }
  /// Slots that pools must have room for; grows by doubling.
  [[nodiscard]] int slotCapacity() const { return slot_capacity_; }
  [[nodiscard]] std::size_t deviceBytes() const;

  /// Slot of a brick or BRICK_NONE.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const { return index_.slotOf(brick); }
  /// Position of the brick in `slot`.
  [[nodiscard]] const Eigen::Vector3i& positionOf(int slot) const;

  /// Allocates those of `bricks` that do not exist (duplicates welcome) with weight 0, on host and device;
  /// slots follow the order of `bricks`. Wakes those that are dormant. Returns how many are new or awake
  /// again.
  int allocate(std::span<const Eigen::Vector3i> bricks);

  /// Lays `slots` (awake ones) aside: views and rays pass them over as if there were no brick, and so cost
  /// nothing. For bricks that noise or a thing now gone once called for, and that hold nothing but free
  /// space. Slot, voxels and labels stay as they are.
  void makeDormant(std::span<const cl_int> slots);
  [[nodiscard]] int dormantCount() const { return dormant_count_; }

  /// Slots of all bricks (but dormant ones) of these pages whose sphere meets the frustum. With the pages
  /// that the frustum meets (BrickPages::pagesInView) these are all in view; cost follows the view, not the
  /// map.
  [[nodiscard]] std::vector<cl_int> slotsInPages(std::span<const int> pages,
                                                 const ViewFrustum& frustum) const;

  [[nodiscard]] const Buffer<BrickEntry>& table() const { return table_.buffer(); }
  [[nodiscard]] cl_uint tableMask() const { return static_cast<cl_uint>(index_.entries().size() - 1); }
  /// slotCapacity() * BRICK_VOXELS.
  [[nodiscard]] Buffer<TsdfVoxel>& voxels() { return voxels_; }
  [[nodiscard]] const Buffer<TsdfVoxel>& voxels() const { return voxels_; }

  /// The same directory by pages (brick_page.h), for kernels that walk along rays.
  [[nodiscard]] const BrickPages& pages() const { return pages_; }
  [[nodiscard]] const Buffer<cl_int>& pageSlots() const { return page_slots_.buffer(); }

 private:
  void reserve(int slots);

  ComputeContext& compute_;
  float voxel_size_m_;
  BrickIndex index_;
  BrickPages pages_;
  std::vector<Eigen::Vector3i> positions_;  ///< by slot
  std::vector<bool> dormant_;               ///< by slot
  int dormant_count_ = 0;
  DeviceMirror<BrickEntry> table_;
  DeviceMirror<cl_int> page_slots_;
  Buffer<TsdfVoxel> voxels_;
  int slot_capacity_ = 0;
};

}  // namespace scantrove
