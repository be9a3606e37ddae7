#pragma once
#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/compute/compute_context.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// Bricks of a wall that fills the view of `K` at max_depth_m. One view may need about as many, and all of
/// a view is on the device. A map needs room for them, whatever its budget.
[[nodiscard]] double bricksOfOneView(const FusionParams& params, const Intrinsics& K);

/// Rejects a map without room for one view. Error: how much is missing, and which voxel size or range would
/// fit.
[[nodiscard]] Result<void> checkMapFits(const FusionParams& params, const Intrinsics& K,
                                        const DeviceMemory& memory);

/// For a map that outgrew the device during a scan (one view saw too much, or bricks could not be moved to
/// disk): the voxel size at which `times` as much surface would have fit, in metres, rounded up to tenths
/// of a millimetre.
[[nodiscard]] double voxelSizeFor(double times, double voxel_size_m);

}  // namespace scantrove
