#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/segmentation/segment_map.h"

namespace scantrove {

/// The bipartite graph of thesis 3.3.2: segments of S_t on one side, regions of S_prj,t on the other, an edge
/// where they share pixels.
struct OverlapGraph {
  struct Edge {
    std::uint32_t segment;  ///< id in S_t
    std::uint32_t region;   ///< index into region_ids
    int overlap_px;         ///< o_ij
  };
  std::vector<std::uint32_t> region_ids;  ///< regions in view, by first pixel
  std::vector<int> region_areas_px;       ///< a_j, by index
  std::vector<int> segment_areas_px;      ///< a_i, by id; [0] unused
  std::vector<Edge> edges;                ///< by segment, then region index

  /// The merging criterion of thesis 3.3.1: o_ij / a_i > threshold or o_ij / a_j > threshold.
  [[nodiscard]] bool qualifies(const Edge& edge, float threshold) const {
    const auto overlap = static_cast<float>(edge.overlap_px);
    return overlap > threshold * static_cast<float>(segment_areas_px[edge.segment]) ||
           overlap > threshold * static_cast<float>(region_areas_px[edge.region]);
  }
};

/// `projected` holds region ids, pixel by pixel like `segments.ids`; 0 = nothing. One pass over the pixels.
[[nodiscard]] OverlapGraph buildOverlapGraph(const SegmentMap& segments,
                                             std::span<const std::uint32_t> projected);

}  // namespace scantrove
