#include "core/labeling/overlap_graph.h"

#include <unordered_map>

#include "core/base/check.h"

namespace scantrove {

template <class PatchId>
OverlapGraph<PatchId> buildOverlapGraph(const SegmentMap& segments, std::span<const PatchId> projected) {
  SCANTROVE_CHECK(projected.size() == segments.ids.size());
  OverlapGraph<PatchId> graph;
  graph.segment_areas_px = segments.areas;
  const std::size_t segment_count = segments.areas.size();

  // Counts by (patch index, segment); one row per patch, added with its first pixel.
  std::vector<int> counts;
  std::unordered_map<PatchId, std::uint32_t> index_of_patch;
  for (std::size_t first = 0, pixel = 0; first < projected.size(); first = pixel) {
    const PatchId patch = projected[first];
    const std::uint32_t segment = segments.ids[first];
    while (pixel < projected.size() && projected[pixel] == patch && segments.ids[pixel] == segment) ++pixel;
    if (!patch) continue;
    const auto [entry, is_new] =
        index_of_patch.try_emplace(patch, static_cast<std::uint32_t>(graph.patches.size()));
    if (is_new) {
      graph.patches.push_back(patch);
      graph.patch_areas_px.push_back(0);
      counts.resize(counts.size() + segment_count, 0);
    }
    const auto run = static_cast<int>(pixel - first);
    graph.patch_areas_px[entry->second] += run;
    counts[entry->second * segment_count + segment] += run;
  }

  for (std::uint32_t segment = 1; segment < segment_count; ++segment) {
    for (std::uint32_t patch = 0; patch < graph.patches.size(); ++patch) {
      const int overlap = counts[patch * segment_count + segment];
      if (overlap > 0) graph.edges.push_back({segment, patch, overlap});
    }
  }
  return graph;
}

template OverlapGraph<FragmentId> buildOverlapGraph(const SegmentMap&, std::span<const FragmentId>);
template OverlapGraph<RegionId> buildOverlapGraph(const SegmentMap&, std::span<const RegionId>);

}  // namespace scantrove
