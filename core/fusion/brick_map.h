#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_budget.h"
#include "core/fusion/brick_pages.h"
#include "core/fusion/brick_pools.h"
#include "core/fusion/brick_store.h"
#include "core/fusion/device_bricks.h"
#include "core/fusion/stored_page.h"

namespace scantrove {

/// Sorts by x, y, z. Kernels list bricks in the arbitrary order of their threads; sorting makes slots
/// reproducible.
void sortBricks(std::vector<Eigen::Vector3i>& bricks);

/// The map's 8^3 bricks, and their movement between the device (DeviceBricks) and a file (BrickStore). Only
/// memory limits extent and position.
///
/// Beyond the device's budget, the pages that were out of view longest move to a file. They return unchanged
/// when a view meets them. Results for bricks in view are therefore equal, to the last bit, to those with
/// unlimited memory. The context's thread.
class BrickMap {
 public:
  BrickMap(ComputeContext& compute, float voxel_size_m, const BrickBudget& budget = {});

  [[nodiscard]] float voxelSize() const { return device_.voxelSize(); }
  /// All bricks, including inactive ones and those in the file.
  [[nodiscard]] int brickCount() const { return device_.brickCount() + stored_count_; }
  /// Disk space in use.
  [[nodiscard]] std::uint64_t storedBytes() const { return store_.usedBytes(); }

  /// The bricks on the device.
  [[nodiscard]] const DeviceBricks& device() const { return device_; }
  /// Their voxels.
  [[nodiscard]] BrickPools& pools() { return device_.pools(); }
  [[nodiscard]] const BrickPools& pools() const { return device_.pools(); }
  /// All pages, including those in the file.
  [[nodiscard]] const BrickPages& pages() const { return device_.pages(); }

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

 private:
  /// Keeps the existing pages of `bricks` on the device until the next view.
  void holdPagesOf(std::span<const Eigen::Vector3i> bricks);
  void bringBack(std::span<const int> pages);
  /// Makes room for `count` more bricks: moves pages to the file, and grows if that is not enough.
  void makeRoom(int count);
  /// Moves a page to the file. False, without any change, if writing fails.
  bool sendAway(int page);
  /// Writes a page to the file. False if that fails.
  bool putAway(int page, const StoredPage& stored);
  void forgetStored(int page);

  DeviceBricks device_;
  BrickStore store_;
  bool may_store_;
  std::optional<Error> failure_;
  std::uint64_t view_ = 1;  ///< number of the last view
  int inactive_count_ = 0;
  int stored_count_ = 0;
};

}  // namespace scantrove
