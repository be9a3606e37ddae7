#pragma once
#include <set>
#include <vector>

#include "core/dataset/labeled_scan.h"
#include "core/editing/operation_log.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// What a person painted in the image of a key frame (SavedFrame::number), oldest first, for the regions as
/// they are now. A region that was joined with another paints for that one. After a later join into a region,
/// earlier removals from it no longer hold, and after a later split, each part keeps its own pixels.
[[nodiscard]] std::vector<PaintedMask> paintedMasksOf(const OperationLog& log, const RegionTable& table,
                                                      int key_frame);

/// Key frames that have any.
[[nodiscard]] std::set<int> paintedKeyFrames(const OperationLog& log);

}  // namespace scantrove
