#pragma once
#include <stop_token>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"

namespace scantrove {

/// exportDataset() of the format mesh, but that the middle of each object's box lies in the origin of its
/// files: as programs want a thing that they place themselves. Beside them objects/NNNNNN_name.json says what
/// brings it back to its place in the scene: `offset_m`, and in the frame of the GLB files `glb_offset_m`.
/// The files of the whole scene are those of exportDataset().
[[nodiscard]] Result<ExportSummary> exportCenteredMesh(LabeledScan& scan, const ExportOptions& options,
                                                       const ExportProgressCallback& progress = {},
                                                       const std::stop_token& cancel = {});

}  // namespace scantrove
