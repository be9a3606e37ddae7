#include "core/pipeline/map_memory.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/fusion/brick_budget.h"
#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {
namespace {

constexpr double kBrickPoolBytes = BRICK_VOXELS * VOXEL_BYTES;
constexpr double kGigabyte = 1e9;

template <class... Parts>
std::string text(int decimals, const Parts&... parts) {
  std::ostringstream stream;
  stream << std::fixed << std::setprecision(decimals);
  (stream << ... << parts);
  return stream.str();
}

double tenthsUp(double value) { return std::ceil(10 * value - 1e-9) / 10; }

}  // namespace

double bricksOfOneView(const FusionParams& params, const Intrinsics& K) {
  const double depth_m = params.max_depth_m;
  const double area_m2 = (K.width * depth_m / K.fx) * (K.height * depth_m / K.fy);
  const double brick_m = BRICK_SIDE * static_cast<double>(params.voxel_size_m);
  // The band around a surface overlaps one more layer of bricks than its thickness.
  const double layers = 2 * static_cast<double>(params.truncation_vox) / BRICK_SIDE + 1;
  return layers * area_m2 / (brick_m * brick_m);
}

double voxelSizeFor(double times, double voxel_size_m) {
  return tenthsUp(1000 * voxel_size_m * std::sqrt(times)) / 1000;
}

Result<void> checkMapFits(const FusionParams& params, const Intrinsics& K, const DeviceMemory& memory) {
  const double needed = bricksOfOneView(params, K);
  const double room = bricksThatFit(memory);
  if (needed <= room) return {};
  const double depth_m = std::floor(10 * params.max_depth_m * std::sqrt(room / needed)) / 10;
  std::string advice =
      text(4, "What would fit: --set fusion.voxel_size_m=", voxelSizeFor(needed / room, params.voxel_size_m));
  if (depth_m >= 2 * static_cast<double>(params.min_depth_m)) {
    advice += text(1, ", or a shorter range, --set fusion.max_depth_m=", depth_m);
  }
  return fail(text(1, "A map of voxels of ", 1000 * static_cast<double>(params.voxel_size_m),
                   " mm does not fit: one view out to ", params.max_depth_m, " m needs about ",
                   needed * kBrickPoolBytes / kGigabyte, " GB, and the device has room for ",
                   room * kBrickPoolBytes / kGigabyte, " GB."),
              advice + ".");
}

}  // namespace scantrove
