#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// Hash for unordered containers of bricks.
struct BrickHash {
  std::size_t operator()(const Eigen::Vector3i& brick) const {
    return brick_hash(brick.x(), brick.y(), brick.z());
  }
};

/// The hash table brick -> slot on the host, laid out entry by entry as kernels read it (brick_layout.h).
/// The load is at most one half.
class BrickIndex {
 public:
  BrickIndex();

  /// Slot of `brick` or BRICK_NONE.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const;

  /// Adds a brick that is not in the table. Returns its entry. When the table grows (`entries().size()`
  /// changes), every entry moves.
  std::size_t insert(const Eigen::Vector3i& brick, int slot);

  /// Removes a brick that is in the table. Appends the changed entries to `changed`: later ones move up, so
  /// that a search still ends at the first free entry.
  void erase(const Eigen::Vector3i& brick, std::vector<std::size_t>& changed);

  /// The table; its size is a power of two.
  [[nodiscard]] std::span<const BrickEntry> entries() const { return entries_; }

 private:
  /// Entry of the brick, or the free entry where the search ends.
  [[nodiscard]] std::size_t find(const Eigen::Vector3i& brick) const;
  std::size_t place(const BrickEntry& entry);
  void grow();

  std::vector<BrickEntry> entries_;
  std::size_t count_ = 0;
};

}  // namespace scantrove
