#pragma once
#include <span>
#include <vector>

#include "core/labeling/evidence_graph.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// Fragments with fewer voxels are too small to be an object of their own.
inline constexpr int kSmallFragmentVoxels = 50;

/// Repartitions only the regions of the `touched` fragments (those with changed evidence). One region splits
/// when its log-odds fall below minus `params.hysteresis`; two join when they exceed it. Constraints override
/// evidence; among contradicting ones a person's win, then the newest. Evidence never joins a region that a
/// person marked as an object with another such region or with background. A fragment under
/// kSmallFragmentVoxels without constraint follows the fragment with which it shares the longest border.
/// `voxels`: by fragment number.
void updatePartition(std::span<const FragmentId> touched, const EvidenceGraph& graph,
                     std::span<const int> voxels, const LabelingParams& params, RegionTable& table,
                     RegionEvents& events);

/// The parts of one region by the graph's evidence.
[[nodiscard]] std::vector<std::vector<FragmentId>> partsOfRegion(RegionId region, const EvidenceGraph& graph,
                                                                 std::span<const int> voxels,
                                                                 const LabelingParams& params,
                                                                 const RegionTable& table);

}  // namespace scantrove
