#include "core/fusion/brick_budget.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/fusion/brick_store.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {
namespace {

constexpr double kPoolBytes = BRICK_VOXELS * static_cast<double>(sizeof(cl_uint));  // of a brick, the largest
/// In units of the largest pool: all pools are 2.75 of it, plus half of one while it is replaced.
constexpr double kGrowingPools = 3.5;
constexpr double kMebibyte = 1 << 20;

double machineBytes() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}

}  // namespace

double bricksThatFit(const DeviceMemory& memory) {
  const double in_one_buffer = static_cast<double>(memory.largest_buffer_bytes) / kPoolBytes;
  const double in_all = static_cast<double>(memory.total_bytes) / (kGrowingPools * kPoolBytes);
  return std::floor(std::min({in_one_buffer, in_all, static_cast<double>(kMaxBricks)}));
}

BrickBudget brickBudget(const FusionParams& params, const ComputeContext& compute) {
  const double bytes = params.memory_budget_mb > 0 ? params.memory_budget_mb * kMebibyte : machineBytes() / 4;
  const double bricks = std::min(bytes / kBrickBytes, bricksThatFit(compute.memory()));
  return {std::max(1, static_cast<int>(bricks)), compute.isCpu(), folderForBricks()};
}

}  // namespace scantrove
