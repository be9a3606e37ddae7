#pragma once
#include <filesystem>

#include "core/compute/compute_context.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// Device memory of one brick: what it holds, and its share of the directory.
constexpr double kBrickBytes = BRICK_VOXELS * VOXEL_BYTES + 128;

/// Kernels count voxels with 31 bits.
constexpr int kMaxBricks = (1 << 22) - 1;

/// How many bricks stay on the device, and what becomes of others.
struct BrickBudget {
  int bricks = kMaxBricks;       ///< as long as one view needs no more
  bool at_once = false;          ///< room for all is made at once, rather than by growing
  std::filesystem::path folder;  ///< of the file that takes those for which there is no room; empty: no file
};

/// Bricks that the device has room for while their pools grow: all pools, and beside them half of one that is
/// being replaced.
[[nodiscard]] double bricksThatFit(const DeviceMemory& memory);

/// The budget that `params` asks for: a quarter of the machine's memory where it says nothing, and no more
/// than the device has room for. CPU devices get theirs at once: their memory is the system's, and what is
/// not used of it costs nothing.
[[nodiscard]] BrickBudget brickBudget(const FusionParams& params, const ComputeContext& compute);

}  // namespace scantrove
