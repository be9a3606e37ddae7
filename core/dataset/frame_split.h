#pragma once
#include <set>
#include <string>

#include "core/base/result.h"
#include "core/dataset/export_job.h"

namespace scantrove {

/// The frames of an export for training and for validation. The last fifth of the frames (if at least five)
/// is for validation, because neighbours in time are similar.
struct FrameSplit {
  std::set<int> training;  ///< KeyFrameInfo::index
  bool has_validation = false;
};

/// Splits framesToExport() with colour. Error: as of framesToExport().
[[nodiscard]] Result<FrameSplit> splitFrames(ExportJob& job);

}  // namespace scantrove
