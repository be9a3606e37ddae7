#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/segmentation/segment_map.h"

namespace scantrove {

/// The bipartite graph of thesis 3.3.2: segments of S_t on one side, patches of S_prj,t on the other (regions
/// in the thesis' rule, fragments in the graph's), an edge where they share pixels.
template <class PatchId>
struct OverlapGraph {
  struct Edge {
    std::uint32_t segment;  ///< id in S_t
    std::uint32_t patch;    ///< index into patches
    int overlap_px;         ///< o_ij
  };
  std::vector<PatchId> patches;       ///< in view, by first pixel
  std::vector<int> patch_areas_px;    ///< a_j, by index
  std::vector<int> segment_areas_px;  ///< a_i, by id; [0] unused
  std::vector<Edge> edges;            ///< by segment, then patch index

  /// The merging criterion of thesis 3.3.1: o_ij / a_i > threshold or o_ij / a_j > threshold.
  [[nodiscard]] bool qualifies(const Edge& edge, float threshold) const {
    const auto overlap = static_cast<float>(edge.overlap_px);
    return overlap > threshold * static_cast<float>(segment_areas_px[edge.segment]) ||
           overlap > threshold * static_cast<float>(patch_areas_px[edge.patch]);
  }

  /// The segment holds more than the part `threshold` of the patch's visible pixels.
  [[nodiscard]] bool covers(const Edge& edge, float threshold) const {
    return static_cast<float>(edge.overlap_px) > threshold * static_cast<float>(patch_areas_px[edge.patch]);
  }
};

/// One pass over the pixels. `projected`: pixel by pixel like `segments.ids`; none = no patch. Instantiated
/// for FragmentId and RegionId.
template <class PatchId>
[[nodiscard]] OverlapGraph<PatchId> buildOverlapGraph(const SegmentMap& segments,
                                                      std::span<const PatchId> projected);

}  // namespace scantrove
