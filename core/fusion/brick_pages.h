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

/// Bricks grouped into pages of 8^3, so that a question about a view looks at the pages of that view and at
/// nothing else. On the device a page is a block: a dense table local brick -> slot (brick_page.h); block 0
/// is the empty one. A page that is not on the device has no block. Pages are numbered as they are met, for
/// good.
class BrickPages {
 public:
  struct Page {
    Eigen::Vector3i position = Eigen::Vector3i::Zero();  ///< first brick / 8
    int block = PAGE_EMPTY;                              ///< of pageSlots(); PAGE_EMPTY: not on the device
    std::vector<int> slots;                              ///< its bricks' slots, ascending
    std::vector<int> inactive;                           ///< slots of those laid aside
    std::uint64_t last_view = 0;                         ///< number of the view that met it last
    std::optional<BrickStore::Record> record;            ///< where it is while it is not on the device
    std::bitset<PAGE_BRICKS> stored;                     ///< bricks in the record
    int stored_inactive = 0;                             ///< how many of them are laid aside

    [[nodiscard]] int bricksHere() const { return static_cast<int>(slots.size() + inactive.size()); }
  };
  using Cells = std::array<int, PAGE_BRICKS>;

  BrickPages();

  /// Adds a brick that is not there, or wakes it. Appends the indices of the elements of `pageSlots()` that
  /// were set to `changed`.
  void insert(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed);

  /// The number of the page at this position, which may be new and empty.
  int add(const Eigen::Vector3i& position);

  /// Lays a brick aside: kernels see none in its place. `changed` as with insert.
  void deactivate(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed);

  /// Takes a page off the device, with what its block held.
  Cells takeOut(int index);

  /// Puts a page that has no block on the device: the block as it was taken out, but with the slots that its
  /// bricks have now, of which `dormant` are not in the block.
  void putBack(int index, const Cells& cells, std::vector<int> inactive, std::vector<std::size_t>& changed);

  /// Indices of the pages that the frustum meets, in a fixed order. `brick_size_m` is the side of a brick.
  [[nodiscard]] std::vector<int> pagesInView(const ViewFrustum& frustum, double brick_size_m) const;

  /// Number of the page that a brick lies in, BRICK_NONE if there was no brick yet.
  [[nodiscard]] int pageWith(const Eigen::Vector3i& brick) const;
  [[nodiscard]] const Page& page(int index) const { return pages_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] Page& page(int index) { return pages_[static_cast<std::size_t>(index)]; }
  /// Pages have the indices 1 .. count() - 1.
  [[nodiscard]] int count() const { return static_cast<int>(pages_.size()); }

  /// PAGE_BRICKS slots for each block, one block after the other.
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

/// Of a brick in its page, as in brick_page.h.
[[nodiscard]] std::size_t localBrick(const Eigen::Vector3i& brick);
/// The brick with that index in a page.
[[nodiscard]] Eigen::Vector3i brickOfPage(const BrickPages::Page& page, std::size_t local);

}  // namespace scantrove
