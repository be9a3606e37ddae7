#include "core/labeling/region_merger.h"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace scantrove {
namespace {

constexpr int kMostVotesAgainst = 2;     // times evidence_frames
constexpr int kLeastTouchingPixels = 8;  // fewer are noise of the outline

using RegionPair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of regions (smaller id first) that are neighbours along enough pixels of the image.
std::vector<RegionPair> touchingRegions(const std::vector<std::uint32_t>& regions, int width) {
  std::vector<RegionPair> contacts;
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b && a != 0 && b != 0) contacts.push_back(std::minmax(a, b));
  };
  const auto row_length = static_cast<std::size_t>(width);
  for (std::size_t pixel = 0; pixel < regions.size(); ++pixel) {
    if ((pixel + 1) % row_length != 0) meet(regions[pixel], regions[pixel + 1]);
    if (pixel + row_length < regions.size()) meet(regions[pixel], regions[pixel + row_length]);
  }
  std::sort(contacts.begin(), contacts.end());
  std::vector<RegionPair> touching;
  for (std::size_t first = 0, next = 0; first < contacts.size(); first = next) {
    while (next < contacts.size() && contacts[next] == contacts[first]) ++next;
    if (next - first >= kLeastTouchingPixels) touching.push_back(contacts[first]);
  }
  return touching;
}

/// Edges of each segment that fulfil a criterion, largest overlap first.
using EdgesOfSegment = std::vector<std::vector<OverlapGraph::Edge>>;
using Criterion = bool (OverlapGraph::*)(const OverlapGraph::Edge&, float) const;

EdgesOfSegment edgesBySegment(const OverlapGraph& graph, Criterion holds, float threshold) {
  EdgesOfSegment edges(graph.segment_areas_px.size());
  for (const OverlapGraph::Edge& edge : graph.edges) {
    if ((graph.*holds)(edge, threshold)) edges[edge.segment].push_back(edge);
  }
  for (auto& of_segment : edges) {
    std::stable_sort(of_segment.begin(), of_segment.end(),
                     [](const auto& a, const auto& b) { return a.overlap_px > b.overlap_px; });
  }
  return edges;
}

void joinRegions(RegionId a, RegionId b, LabelTable& table, RegionMerger::Outcome& outcome) {
  const RegionId into = table.regionOf(a.value);
  const RegionId from = table.regionOf(b.value);
  if (table.join(into, from)) outcome.joined.emplace_back(into, from);
}

}  // namespace

void RegionMerger::joinComponents(const OverlapGraph& graph, const LabelingParams& params, LabelTable& table,
                                  Outcome& outcome) const {
  const std::size_t region_count = graph.region_ids.size();
  std::vector<std::vector<std::uint32_t>> segments_of(region_count);
  std::vector<std::vector<std::uint32_t>> regions_of(graph.segment_areas_px.size());
  for (const OverlapGraph::Edge& edge : graph.edges) {
    if (!graph.qualifies(edge, params.overlap_threshold)) continue;
    segments_of[edge.region].push_back(edge.segment);
    regions_of[edge.segment].push_back(edge.region);
  }
  std::vector<bool> visited(region_count, false);
  std::vector<bool> segment_visited(regions_of.size(), false);
  for (std::uint32_t start = 0; start < region_count; ++start) {
    if (visited[start]) continue;
    std::vector<std::uint32_t> component{start};
    visited[start] = true;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const std::uint32_t segment : segments_of[component[next]]) {
        if (segment_visited[segment]) continue;
        segment_visited[segment] = true;
        for (const std::uint32_t region : regions_of[segment]) {
          if (visited[region]) continue;
          visited[region] = true;
          component.push_back(region);
        }
      }
    }
    const std::uint32_t largest = *std::max_element(component.begin(), component.end(), [&](auto a, auto b) {
      return graph.region_areas_px[a] < graph.region_areas_px[b];
    });
    for (const std::uint32_t region : component) {
      if (region == largest) continue;
      joinRegions(RegionId{graph.region_ids[largest]}, RegionId{graph.region_ids[region]}, table, outcome);
    }
  }
}

void RegionMerger::joinByEvidence(const OverlapGraph& graph, const std::vector<RegionPair>& touching,
                                  const LabelingParams& params, LabelTable& table, Outcome& outcome) {
  std::set<RegionPair> bridged;
  for (const auto& edges : edgesBySegment(graph, &OverlapGraph::covers, params.overlap_threshold)) {
    for (std::size_t a = 0; a < edges.size(); ++a) {
      for (std::size_t b = a + 1; b < edges.size(); ++b) {
        bridged.insert(std::minmax(graph.region_ids[edges[a].region], graph.region_ids[edges[b].region]));
      }
    }
  }
  for (const RegionPair& pair : touching) {
    if (bridged.contains(pair)) continue;
    int& votes = evidence_[pair];
    votes = std::max(votes - 1, -kMostVotesAgainst * params.evidence_frames);
  }
  std::unordered_map<std::uint32_t, int> area_in_view;
  for (std::size_t j = 0; j < graph.region_ids.size(); ++j)
    area_in_view[graph.region_ids[j]] = graph.region_areas_px[j];
  for (const RegionPair& pair : bridged) {
    if (++evidence_[pair] < params.evidence_frames) continue;
    const bool first_is_larger = area_in_view[pair.first] >= area_in_view[pair.second];
    joinRegions(RegionId{first_is_larger ? pair.first : pair.second},
                RegionId{first_is_larger ? pair.second : pair.first}, table, outcome);
  }
  if (!outcome.joined.empty()) renameJoined(table);
}

void RegionMerger::renameJoined(const LabelTable& table) {
  std::map<RegionPair, int> renamed;
  for (const auto& [pair, votes] : evidence_) {
    const RegionPair now = std::minmax(table.regionOf(pair.first).value, table.regionOf(pair.second).value);
    if (now.first == now.second) continue;
    const auto [entry, is_new] = renamed.try_emplace(now, votes);
    if (!is_new && std::abs(votes) > std::abs(entry->second))
      entry->second = votes;  // the one that knows more
  }
  evidence_ = std::move(renamed);
}

RegionMerger::Outcome RegionMerger::merge(const SegmentMap& segments,
                                          std::span<const std::uint32_t> projected, LabelTable& table,
                                          const LabelingParams& params) {
  Outcome outcome;
  std::vector<std::uint32_t> projected_regions(projected.size());
  const auto& region_of_label = table.regionOfLabel();
  std::transform(projected.begin(), projected.end(), projected_regions.begin(),
                 [&](std::uint32_t label) { return region_of_label[label]; });
  const OverlapGraph graph = buildOverlapGraph(segments, projected_regions);

  const bool by_evidence = params.rule == LabelingParams::Rule::evidence;
  if (by_evidence) {
    joinByEvidence(graph, touchingRegions(projected_regions, segments.width), params, table, outcome);
  } else {
    joinComponents(graph, params, table, outcome);
  }

  // The label of each segment, and the regions whose pixels it leaves alone.
  const EdgesOfSegment edges = edgesBySegment(graph, &OverlapGraph::qualifies, params.overlap_threshold);
  const EdgesOfSegment covered = edgesBySegment(graph, &OverlapGraph::covers, params.overlap_threshold);
  std::vector<std::uint32_t> label_of_segment(segments.areas.size(), 0);
  std::vector<std::vector<std::uint32_t>> kept_regions(segments.areas.size());
  for (std::uint32_t segment = 1; segment < label_of_segment.size(); ++segment) {
    if (edges[segment].empty()) {
      label_of_segment[segment] = table.newLabel().value;
      continue;
    }
    label_of_segment[segment] = table.regionOf(graph.region_ids[edges[segment].front().region]).value;
    for (const OverlapGraph::Edge& edge : covered[segment]) {
      const std::uint32_t region = table.regionOf(graph.region_ids[edge.region]).value;
      if (region != label_of_segment[segment]) kept_regions[segment].push_back(region);
    }
  }

  const auto& regions_now = table.regionOfLabel();
  RegionMap& map = outcome.map;
  map.width = segments.width;
  map.height = segments.height;
  map.labels.resize(projected.size());
  map.regions.resize(projected.size());
  for (std::size_t pixel = 0; pixel < projected.size(); ++pixel) {
    const std::uint32_t segment = segments.ids[pixel];
    std::uint32_t label = label_of_segment[segment];
    const std::uint32_t projected_region = regions_now[projected_regions[pixel]];
    const auto& kept = kept_regions[segment];
    if (segment == 0 || std::find(kept.begin(), kept.end(), projected_region) != kept.end())
      label = projected_region;
    map.labels[pixel] = label;
    map.regions[pixel] = regions_now[label];
  }
  return outcome;
}

}  // namespace scantrove
