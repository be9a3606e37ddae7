#pragma once
#include <span>
#include <vector>

#include "core/labeling/evidence_graph.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// Regions of under so many voxels are slivers: too little to be a thing of their own.
inline constexpr int kSmallFragmentVoxels = 50;

/// Divides the regions of the `touched` fragments (those whose evidence changed) anew by what the graph now
/// says, and no other. With hysteresis: what is one region stays one until the log-odds fall under minus
/// `params.hysteresis`, what is two stays two until they pass it. Constraints hold whatever was seen; of
/// those that contradict one another a person's, and the newest. Regions that a person said to be things of
/// their own are not joined by evidence with one another or with background. A fragment under
/// kSmallFragmentVoxels without constraint goes with the fragment that it touches along the longest border.
/// `voxels`: by fragment number.
void updatePartition(std::span<const FragmentId> touched, const EvidenceGraph& graph,
                     std::span<const int> voxels, const LabelingParams& params, RegionTable& table,
                     RegionEvents& events);

/// What the graph would part one region into.
[[nodiscard]] std::vector<std::vector<FragmentId>> partsOfRegion(RegionId region, const EvidenceGraph& graph,
                                                                 std::span<const int> voxels,
                                                                 const LabelingParams& params,
                                                                 const RegionTable& table);

}  // namespace scantrove
