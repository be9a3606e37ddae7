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
  int least_cover_px = 0;                 ///< 1/2000 of the image: 38 pixels of 320 x 240

  /// The merging criterion of thesis 3.3.1: o_ij / a_i > threshold or o_ij / a_j > threshold.
  [[nodiscard]] bool qualifies(const Edge& edge, float threshold) const {
    const auto overlap = static_cast<float>(edge.overlap_px);
    return overlap > threshold * static_cast<float>(segment_areas_px[edge.segment]) ||
           overlap > threshold * static_cast<float>(region_areas_px[edge.region]);
  }

  /// A stricter criterion, for joining: the segment covers that part of what is seen of the region, and not
  /// by a sliver along an outline. (A small segment astride a border overlaps both sides by much of *its*
  /// area.)
  [[nodiscard]] bool covers(const Edge& edge, float threshold) const {
    return static_cast<float>(edge.overlap_px) >
               threshold * static_cast<float>(region_areas_px[edge.region]) &&
           edge.overlap_px >= least_cover_px;
  }
};

/// `projected` holds region ids, pixel by pixel like `segments.ids`; 0 = nothing. One pass over the pixels.
[[nodiscard]] OverlapGraph buildOverlapGraph(const SegmentMap& segments,
                                             std::span<const std::uint32_t> projected);

}  // namespace scantrove
