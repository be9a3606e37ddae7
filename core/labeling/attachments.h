#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/region_merger.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// One observation of two touching regions: whether one is supported as a part of the other.
///
/// An object stands or lies on a surface that is flat at the contact. A region is attached if it touches only
/// one other region and that region is curved at the contact. Examples are a head on shoulders, a plant in a
/// pot and the spout of a can.
struct Attachment {
  RegionId a, b;     ///< a < b
  bool is_attached;  ///< false: one was seen well enough to decide, and neither is attached
  std::vector<std::pair<FragmentId, FragmentId>> borders;  ///< where a and b touch
};

/// Attachments between the regions of one frame that are no larger than objects. Labels come from `merged`,
/// vertices and normals from `input`. Regions with too much of the outline hidden or cut off are left out.
/// Ordered by (a, b).
[[nodiscard]] std::vector<Attachment> findAttachments(const MergeInput& input,
                                                      const RegionMerger::Outcome& merged,
                                                      const RegionTable& table);

}  // namespace scantrove
