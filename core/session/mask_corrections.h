#pragma once
#include <set>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/labeled_scan.h"
#include "core/editing/operation_log.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// What a person painted in the image of a key frame (SavedFrame::number), oldest first, for the regions as
/// they are now. A region that was joined with another paints for that one. After a later join into a region,
/// earlier removals from it no longer hold, and after a later split, each part keeps its own pixels.
[[nodiscard]] std::vector<PaintedMask> paintedMasksOf(const OperationLog& log, const RegionTable& table,
                                                      int key_frame);

/// Error: nothing is painted for the region in the image of an operation of the kind unpaint.
[[nodiscard]] Result<void> checkUnpaint(const OperationLog& log, const RegionTable& table,
                                        const Operation& unpaint);

/// Key frames in which a person painted, even if all of it was taken away since.
[[nodiscard]] std::set<int> paintedKeyFrames(const OperationLog& log);

}  // namespace scantrove
