#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/fusion/brick_index.h"
#include "core/fusion/kernels/brick_page.h"
#include "core/fusion/view_frustum.h"

namespace scantrove {

/// Bricks grouped into pages of 8^3, so that a question about a view looks at the pages of that view and at
/// nothing else. A page is a dense table local brick -> slot (brick_page.h); page 0 is the empty one.
class BrickPages {
 public:
  struct Page {
    Eigen::Vector3i position = Eigen::Vector3i::Zero();  ///< first brick / 8
    std::vector<int> slots;                              ///< its bricks' slots, ascending
  };

  BrickPages();

  /// Adds a brick that is not there. Appends the indices of the elements of `pageSlots()` that were set to
  /// `changed`.
  void insert(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed);

  /// Takes out a brick that is there. `changed` as with insert.
  void remove(const Eigen::Vector3i& brick, int slot, std::vector<std::size_t>& changed);

  /// Indices of the pages that the frustum meets, in a fixed order. `brick_size_m` is the side of a brick.
  [[nodiscard]] std::vector<int> pagesInView(const ViewFrustum& frustum, double brick_size_m) const;

  [[nodiscard]] const Page& page(int index) const { return pages_[static_cast<std::size_t>(index)]; }

  /// PAGE_BRICKS slots for each page, one page after the other.
  [[nodiscard]] std::span<const int> pageSlots() const { return page_slots_; }

 private:
  void keepEmptyBelow(int level, std::size_t page_start, const Eigen::Vector3i& local,
                      std::vector<std::size_t>& changed);

  BrickIndex index_;
  std::vector<Page> pages_;
  std::vector<int> page_slots_;
};

}  // namespace scantrove
