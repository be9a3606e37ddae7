#pragma once
#include <optional>
#include <set>

#include "core/base/result.h"
#include "core/dataset/export_job.h"

namespace scantrove {

/// The split of the frames of the scan in work, for formats that always have one. A scan of a project is in
/// one split as a whole, for training if the project is not split. The frames of a data set of one scan are
/// divided: its last ones are for validation, because neighbours in time are similar.
struct FrameSplit {
  DatasetSplit whole = DatasetSplit::train;
  std::set<int> validation;  ///< KeyFrameInfo::index

  [[nodiscard]] DatasetSplit of(int frame) const {
    return validation.contains(frame) ? DatasetSplit::val : whole;
  }
};

/// Splits framesToExport() with colour. Error: as of framesToExport().
[[nodiscard]] Result<FrameSplit> splitFrames(ExportJob& job);

}  // namespace scantrove
