#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_pages.h"
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
  ~BrickMap();

  [[nodiscard]] float voxelSize() const;
  [[nodiscard]] int brickCount() const;    ///< allocated bricks = used slots, dormant ones too
  [[nodiscard]] int slotCapacity() const;  ///< slots that pools must have room for; grows by doubling
  [[nodiscard]] std::size_t deviceBytes() const;

  /// Slot of a brick or BRICK_NONE.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const;
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
  [[nodiscard]] int dormantCount() const;

  /// Slots of all bricks (but dormant ones) whose sphere meets the view frustum between the depths. Cost
  /// follows the view, not the map.
  [[nodiscard]] std::vector<cl_int> slotsInView(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K,
                                                float min_depth_m, float max_depth_m) const;

  [[nodiscard]] const Buffer<BrickEntry>& table() const;
  [[nodiscard]] cl_uint tableMask() const;
  [[nodiscard]] Buffer<TsdfVoxel>& voxels();  ///< slotCapacity() * BRICK_VOXELS
  [[nodiscard]] const Buffer<TsdfVoxel>& voxels() const;

  /// The same directory by pages (brick_page.h), for kernels that walk along rays.
  [[nodiscard]] const BrickPages& pages() const;

  /// slotsInView for a caller that has the view's pages already.
  [[nodiscard]] std::vector<cl_int> slotsInPages(std::span<const int> pages,
                                                 const ViewFrustum& frustum) const;
  [[nodiscard]] const Buffer<cl_int>& pageSlots() const;

 private:
  struct Directory;
  std::unique_ptr<Directory> directory_;
};

}  // namespace scantrove
