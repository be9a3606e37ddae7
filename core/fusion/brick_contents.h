#pragma once
#include <cstddef>
#include <vector>

#include "core/compute/opencl.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// What bricks hold, on the host: BRICK_VOXELS of each, brick after brick (brick_layout.h).
struct BrickContents {
  BrickContents() = default;
  /// Of bricks that were never seen.
  explicit BrickContents(std::size_t bricks)
      : distances(bricks * BRICK_VOXELS, DISTANCE_UNSEEN),
        weights(distances.size()),
        labels(distances.size()),
        colors(distances.size()) {}

  [[nodiscard]] std::size_t voxels() const { return distances.size(); }
  bool operator==(const BrickContents&) const = default;

  std::vector<cl_short> distances;
  std::vector<cl_uchar> weights;
  std::vector<cl_uint> labels, colors;
};

}  // namespace scantrove
