#pragma once
#include "core/base/result.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// The number of values that a work-item processes at a time (LANES of core/compute/kernels/lanes.clh), and
/// the work-items for an image of `width` x `height` pixels. 16, 8 or 4 fill a processor's vectors; GPUs,
/// which vectorise over work-items, use 1.
class Lanes {
 public:
  Lanes() = default;

  /// `requested` = 1, 4, 8 or 16; or 0: SCANTROVE_LANES of the environment, else the device's best. Error:
  /// any other value.
  [[nodiscard]] static Result<Lanes> choose(const cl::Device& device, int requested);

  [[nodiscard]] int count() const { return count_; }

  /// For work-items with all lanes in one row.
  [[nodiscard]] cl::NDRange overRows(int width, int height) const { return range(width, height, count_, 1); }
  /// For work-items with at most eight lanes, in one row.
  [[nodiscard]] cl::NDRange overEights(int width, int height) const {
    return range(width, height, columns(), 1);
  }
  /// For work-items with lanes in rows of at most eight, and `blocks` such blocks side by side.
  [[nodiscard]] cl::NDRange overBlocks(int width, int height, int blocks = 1) const {
    return range(width, height, blocks * columns(), count_ / columns());
  }

  /// For work-items that process count() pixels in sequence, so that each can reuse results of the previous
  /// one; and the work-group.
  [[nodiscard]] cl::NDRange inTurn(std::size_t pixels) const {
    const auto count = static_cast<std::size_t>(count_);
    return cl::NDRange((pixels + count - 1) / count);
  }
  [[nodiscard]] cl::NDRange inTurnGroup() const { return cl::NDRange(count_ == 1 ? 64 : 8); }

  /// Work-groups for overRows, overEights, overBlocks, and for one pixel a work-item. The size is fixed
  /// because PoCL compiles a kernel again for every group size, and its own choice depends on the image size.
  /// One lane: groups of neighbours, which read neighbouring pixels. More lanes: small groups, because PoCL
  /// gives cores up to 64 groups at a time, so that few large groups would load the cores unevenly.
  [[nodiscard]] cl::NDRange rowGroup() const { return count_ == 1 ? cl::NDRange(32, 4) : cl::NDRange(4, 2); }
  [[nodiscard]] cl::NDRange blockGroup() const { return count_ == 1 ? cl::NDRange(8, 8) : cl::NDRange(4, 1); }
  [[nodiscard]] static cl::NDRange pixelGroup() { return {64, 4}; }

 private:
  explicit Lanes(int count) : count_(count) {}
  [[nodiscard]] int columns() const { return count_ < 8 ? count_ : 8; }
  [[nodiscard]] static cl::NDRange range(int width, int height, int columns, int rows) {
    return {static_cast<cl::size_type>((width + columns - 1) / columns),
            static_cast<cl::size_type>((height + rows - 1) / rows)};
  }

  int count_ = 1;
};

}  // namespace scantrove
