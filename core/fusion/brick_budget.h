#pragma once
#include <filesystem>

#include "core/compute/compute_context.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {

/// Device memory of one brick: its voxels and its share of the directory.
constexpr double kBrickBytes = BRICK_VOXELS * VOXEL_BYTES + 128;

/// Kernels count voxels with 31 bits.
constexpr int kMaxBricks = (1 << 22) - 1;

/// The number of bricks on the device, and where further ones go.
struct BrickBudget {
  int bricks = kMaxBricks;       ///< exceeded only if one view needs more
  bool at_once = false;          ///< allocate all at once instead of growing
  std::filesystem::path folder;  ///< of the file for further bricks; empty: no file
};

/// The number of bricks that fit on the device while pools grow: all pools, plus half of one that is being
/// replaced.
[[nodiscard]] double bricksThatFit(const DeviceMemory& memory);

/// The budget in `params`; by default a quarter of the machine's memory, and never more than fits on the
/// device. CPU devices allocate at once, because unused system memory costs nothing.
[[nodiscard]] BrickBudget brickBudget(const FusionParams& params, const ComputeContext& compute);

}  // namespace scantrove
