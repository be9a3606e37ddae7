#pragma once
#include <cstddef>
#include <vector>

#include "core/compute/opencl.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// Voxels of bricks on the host: BRICK_VOXELS per brick, brick after brick (brick_layout.h).
struct BrickContents {
  BrickContents() = default;
  /// Bricks without observations.
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
