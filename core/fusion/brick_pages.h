#pragma once
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/fusion/brick_index.h"
#include "core/fusion/brick_store.h"
#include "core/fusion/kernels/brick_page.h"
#include "core/fusion/view_frustum.h"

namespace scantrove {

/// Bricks grouped into pages of 8^3, so that a query about a view reads only that view's pages. On the device
/// a page is a block: a dense table local brick -> slot (brick_page.h); block 0 is the empty one. A page that
/// is not on the device has no block. Page numbers are assigned in order of creation and never change.
class BrickPages {
 public:
  struct Page {
    Eigen::Vector3i position = Eigen::Vector3i::Zero();  ///< first brick / 8
    int block = PAGE_EMPTY;                              ///< of pageSlots(); PAGE_EMPTY: not on the device
    std::vector<int> slots;                              ///< its bricks' slots, ascending
    std::vector<int> inactive;                           ///< slots of inactive bricks
    std::uint64_t last_view = 0;                         ///< number of the last view that met it
    std::optional<BrickStore::Record> record;            ///< in the file, while it is not on the device
    std::bitset<PAGE_BRICKS> stored;                     ///< bricks in the record
    int stored_inactive = 0;                             ///< how many of them are inactive

    [[nodiscard]] int bricksHere() const { return static_cast<int>(slots.size() + inactive.size()); }
  };
  using Cells = std::array<int, PAGE_BRICKS>;

  BrickPages();

  /// Adds a new brick, or activates an inactive one. Appends the indices of changed elements of `pageSlots()`
  /// to `changed`.
  void insert(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed);

  /// The number of the page at this position, created empty if needed.
  int add(const Eigen::Vector3i& position);

  /// Makes a brick inactive, so that kernels do not see it. `changed` as in insert().
  void deactivate(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed);

  /// Removes a page from the device; returns its block's cells.
  Cells takeOut(int index);

  /// Restores a page without block on the device, from the cells of takeOut() and the current slots of its
  /// bricks. The slots in `inactive` are left out of the block.
  void putBack(int index, const Cells& cells, std::vector<int> inactive, std::vector<std::size_t>& changed);

  /// Indices of the pages that meet the frustum, in a fixed order. `brick_size_m`: side of a brick.
  [[nodiscard]] std::vector<int> pagesInView(const ViewFrustum& frustum, double brick_size_m) const;

  /// Number of a brick's page; BRICK_NONE if the page does not exist.
  [[nodiscard]] int pageWith(const Eigen::Vector3i& brick) const;
  [[nodiscard]] const Page& page(int index) const { return pages_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] Page& page(int index) { return pages_[static_cast<std::size_t>(index)]; }
  /// Pages have the indices 1 .. count() - 1.
  [[nodiscard]] int count() const { return static_cast<int>(pages_.size()); }

  /// PAGE_BRICKS slots per block, block after block.
  [[nodiscard]] std::span<const int> pageSlots() const { return page_slots_; }

 private:
  void keepEmptyBelow(int level, std::size_t block_start, const Eigen::Vector3i& local,
                      std::vector<std::size_t>& changed);
  int takeBlock();

  BrickIndex index_;
  std::vector<Page> pages_;
  std::vector<int> page_slots_;
  std::vector<int> free_blocks_;
};

/// Local index of a brick in its page (brick_page.h).
[[nodiscard]] std::size_t localBrick(const Eigen::Vector3i& brick);
/// The brick with local index `local` in a page.
[[nodiscard]] Eigen::Vector3i brickOfPage(const BrickPages::Page& page, std::size_t local);

}  // namespace scantrove
