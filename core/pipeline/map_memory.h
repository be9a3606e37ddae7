#pragma once
#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/compute/compute_context.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// Bricks of a wall that fills the view of `K` at max_depth_m: about what one look may need, and the least
/// that a map must have room for, whatever its budget: what one view meets is on the device.
[[nodiscard]] double bricksOfOneView(const FusionParams& params, const Intrinsics& K);

/// Refuses a map that cannot even hold one view. Error: how much is missing, and which voxels or range would
/// fit.
[[nodiscard]] Result<void> checkMapFits(const FusionParams& params, const Intrinsics& K,
                                        const DeviceMemory& memory);

/// For a map that outgrew the device in the middle of a scan (it saw more in one view than fits, or could not
/// send bricks to disk): the size of voxels with which `times` as much
/// surface would have had room, in metres, rounded up to tenths of a millimetre.
[[nodiscard]] double voxelSizeFor(double times, double voxel_size_m);

}  // namespace scantrove
