#pragma once
#include <stop_token>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"

namespace scantrove {

/// The format mesh of exportDataset(), with the centre of each object's box in the origin of its files, for
/// programs that place the objects themselves. objects/NNNNNN_name.json contains the offset back into the
/// scene: `offset_m`, and `glb_offset_m` in the frame of the GLB files. Files of the whole scene are
/// unchanged.
[[nodiscard]] Result<ExportSummary> exportCenteredMesh(LabeledScan& scan, const ExportOptions& options,
                                                       const ExportProgressCallback& progress = {},
                                                       const std::stop_token& cancel = {});

}  // namespace scantrove
