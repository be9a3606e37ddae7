#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// The hash table brick -> slot on the host, laid out entry by entry as kernels read it (brick_layout.h).
/// Load at most one half.
class BrickIndex {
 public:
  BrickIndex();

  /// Slot of `brick` or BRICK_NONE.
  [[nodiscard]] int slotOf(const Eigen::Vector3i& brick) const;

  /// Adds a brick that is not yet there. Returns the entry it went to; every entry moves when the table grows
  /// (`entries().size()` changed).
  std::size_t insert(const Eigen::Vector3i& brick, int slot);

  /// The table; its size is a power of two.
  [[nodiscard]] std::span<const BrickEntry> entries() const { return entries_; }

 private:
  std::size_t place(const BrickEntry& entry);
  void grow();

  std::vector<BrickEntry> entries_;
  std::size_t count_ = 0;
};

}  // namespace scantrove
