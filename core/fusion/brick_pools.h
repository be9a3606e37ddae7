#pragma once
#include <span>
#include <vector>

#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_contents.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// The voxels of a map's bricks on the device, by slot: distance, weight, label and colour of each of the 512
/// voxels (brick_layout.h). All functions may throw cl::Error (out of memory, device lost). The context's
/// thread.
class BrickPools {
 public:
  explicit BrickPools(ComputeContext& compute) : compute_(compute) {}

  [[nodiscard]] int capacity() const { return capacity_; }

  /// Tries to allocate empty pools for `slots` bricks in the memory of a CPU device, where unwritten memory
  /// costs nothing (for example of missing labels and colours). False if there is no room.
  [[nodiscard]] bool makeAtOnce(int slots);

  /// Grows to `slots` bricks; the first `used` keep their contents. Pools grow one after another, so that at
  /// most one old pool exists beside the new ones.
  void grow(int slots, int used);

  /// Resets the slots' voxels to unseen, without label and colour.
  void clear(std::span<const int> slots);

  /// Contents slot after slot, BRICK_VOXELS each.
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
  /// Marks slots as written to.
  void use(std::span<const int> slots);

  ComputeContext& compute_;
  Buffer<cl_short> distances_;
  Buffer<cl_uchar> weights_;
  Buffer<cl_uint> labels_;
  Buffer<cl_uint> colors_;
  int capacity_ = 0;
  int zero_from_ = 0;  ///< slots from here on are empty; capacity_ if unknown
};

}  // namespace scantrove
