#include "core/labeling/overlap_graph.h"

#include <unordered_map>

#include "core/base/check.h"

namespace scantrove {

OverlapGraph buildOverlapGraph(const SegmentMap& segments, std::span<const std::uint32_t> projected) {
  SCANTROVE_CHECK(projected.size() == segments.ids.size());
  OverlapGraph graph;
  graph.segment_areas_px = segments.areas;
  graph.least_cover_px = static_cast<int>(projected.size() / 2000);
  const std::size_t segment_count = segments.areas.size();

  // Counts by (region index, segment); a row a region, made when the region is first seen.
  std::vector<int> counts;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of_region;
  std::uint32_t last_region = 0;
  std::uint32_t last_index = 0;
  for (std::size_t pixel = 0; pixel < projected.size(); ++pixel) {
    const std::uint32_t region = projected[pixel];
    if (region == 0) continue;
    if (region != last_region) {
      const auto [entry, is_new] =
          index_of_region.try_emplace(region, static_cast<std::uint32_t>(graph.region_ids.size()));
      if (is_new) {
        graph.region_ids.push_back(region);
        graph.region_areas_px.push_back(0);
        counts.resize(counts.size() + segment_count, 0);
      }
      last_region = region;
      last_index = entry->second;
    }
    ++graph.region_areas_px[last_index];
    ++counts[last_index * segment_count + segments.ids[pixel]];
  }

  for (std::uint32_t segment = 1; segment < segment_count; ++segment) {
    for (std::uint32_t region = 0; region < graph.region_ids.size(); ++region) {
      const int overlap = counts[region * segment_count + segment];
      if (overlap > 0) graph.edges.push_back({segment, region, overlap});
    }
  }
  return graph;
}

}  // namespace scantrove
