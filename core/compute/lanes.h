#pragma once
#include "core/base/result.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// How many values kernels do at a time, LANES of core/compute/kernels/lanes.clh, and how many work-items an
/// image of `width` x `height` pixels takes with them: 16, 8 or 4 fill the vectors of a processor; GPUs,
/// which vectorise over work-items, have 1.
class Lanes {
 public:
  Lanes() = default;

  /// `wanted` = 1, 4, 8 or 16; or 0: what the environment's SCANTROVE_LANES says, else what suits the device.
  /// Error: neither of these.
  [[nodiscard]] static Result<Lanes> choose(const cl::Device& device, int requested);

  [[nodiscard]] int count() const { return count_; }

  /// Where a work-item does all lanes in one row.
  [[nodiscard]] cl::NDRange overRows(int width, int height) const { return range(width, height, count_, 1); }
  /// Where it does at most eight, in one row.
  [[nodiscard]] cl::NDRange overEights(int width, int height) const {
    return range(width, height, columns(), 1);
  }
  /// Where its lanes lie in rows of at most eight, and it does so many of these blocks side by side.
  [[nodiscard]] cl::NDRange overBlocks(int width, int height, int blocks = 1) const {
    return range(width, height, blocks * columns(), count_ / columns());
  }

  /// Where it does so many pixels of an image one after the other, so that what it knows of one helps with
  /// the next; and the work-group.
  [[nodiscard]] cl::NDRange inTurn(std::size_t pixels) const {
    const auto count = static_cast<std::size_t>(count_);
    return cl::NDRange((pixels + count - 1) / count);
  }
  [[nodiscard]] cl::NDRange inTurnGroup() const { return cl::NDRange(count_ == 1 ? 64 : 8); }

  /// The work-groups of the first two, of the last, and where each work-item does one pixel. One size for
  /// images of any: PoCL compiles a kernel anew for every size of its groups, and its own choice follows the
  /// image's. With one lane, neighbours that read neighbouring pixels; with more, small groups: PoCL hands
  /// them out to the cores up to 64 at a time, so that of few groups one core gets the larger part and the
  /// other waits for it.
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
