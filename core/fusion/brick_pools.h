#pragma once
#include <span>
#include <vector>

#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_contents.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// What the bricks of a map hold, on the device, by slot: a distance, a weight, a label and a colour for each
/// of their 512 voxels (brick_layout.h). All may throw cl::Error (no memory left, device lost). One thread,
/// the context's.
class BrickPools {
 public:
  explicit BrickPools(ComputeContext& compute) : compute_(compute) {}

  [[nodiscard]] int capacity() const { return capacity_; }

  /// Tries to make empty pools for `slots` bricks in the memory of a CPU device, where what is not written to
  /// costs nothing: a brick's labels and colours, say, as long as it has none. False: there is no room.
  [[nodiscard]] bool makeAtOnce(int slots);

  /// Room for `slots` bricks; the first `used` keep what they hold. One pool grows after the other, so that
  /// beside them there is never more than one old pool.
  void grow(int slots, int used);

  /// Voxels never seen, without label and colour.
  void clear(std::span<const int> slots);

  /// Slot after slot, BRICK_VOXELS each.
  [[nodiscard]] BrickContents read(std::span<const int> slots) const;
  void write(std::span<const int> slots, const BrickContents& contents);

  [[nodiscard]] Buffer<cl_short>& distances() { return distances_; }
  [[nodiscard]] const Buffer<cl_short>& distances() const { return distances_; }
  [[nodiscard]] Buffer<cl_uchar>& weights() { return weights_; }
  [[nodiscard]] const Buffer<cl_uchar>& weights() const { return weights_; }
  [[nodiscard]] Buffer<cl_uint>& labels() { return labels_; }
  [[nodiscard]] const Buffer<cl_uint>& labels() const { return labels_; }
  [[nodiscard]] Buffer<cl_uint>& colors() { return colors_; }
  [[nodiscard]] const Buffer<cl_uint>& colors() const { return colors_; }

 private:
  /// Something is or will be written to these.
  void use(std::span<const int> slots);

  ComputeContext& compute_;
  Buffer<cl_short> distances_;
  Buffer<cl_uchar> weights_;
  Buffer<cl_uint> labels_;
  Buffer<cl_uint> colors_;
  int capacity_ = 0;
  int zero_from_ = 0;  ///< slots from here on hold nothing; if that is not known, capacity_
};

}  // namespace scantrove
