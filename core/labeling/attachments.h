#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/region_merger.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// What one look says of two regions that touch: is one a part of the other by the way it is held?
///
/// A thing by itself stands or lies on something, and what it can stand on is flat there. A region that
/// touches nothing but one other, and that other is curved where they meet, stands on nothing: it grows out
/// of it, as a head out of its shoulders, a plant out of its pot, a spout out of the can.
struct Attachment {
  RegionId a, b;     ///< a < b
  bool is_attached;  ///< false: one was seen well enough to say, and none is held by the other alone
  std::vector<std::pair<FragmentId, FragmentId>> borders;  ///< of a and b, where they touch
};

/// Of regions no larger than things are, by what is seen of them in one frame: the labels are those of
/// `merged`, vertices and normals those of `input`. Where too much of an outline is hidden or cut off nothing
/// is said. Ordered by (a, b).
[[nodiscard]] std::vector<Attachment> findAttachments(const MergeInput& input,
                                                      const RegionMerger::Outcome& merged,
                                                      const RegionTable& table);

}  // namespace scantrove
