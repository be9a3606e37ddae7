#include "core/labeling/thesis_merger.h"

#include <algorithm>

namespace scantrove {
namespace {

using RegionOverlaps = OverlapGraph<RegionId>;

void joinComponent(const RegionOverlaps& graph, const std::vector<std::uint32_t>& component,
                   RegionTable& table, RegionEvents& events) {
  const std::uint32_t largest = *std::ranges::max_element(
      component, {}, [&](std::uint32_t patch) { return graph.patch_areas_px[patch]; });
  for (const std::uint32_t patch : component) {
    if (table.join(graph.patches[largest], graph.patches[patch])) {
      events.joined.emplace_back(graph.patches[largest], graph.patches[patch]);
    }
  }
}

/// The components of the patches under qualifying edges.
void joinComponents(const RegionOverlaps& graph, float threshold, RegionTable& table, RegionEvents& events) {
  std::vector<std::vector<std::uint32_t>> segments_of(graph.patches.size());
  std::vector<std::vector<std::uint32_t>> patches_of(graph.segment_areas_px.size());
  for (const RegionOverlaps::Edge& edge : graph.edges) {
    if (!graph.qualifies(edge, threshold)) continue;
    segments_of[edge.patch].push_back(edge.segment);
    patches_of[edge.segment].push_back(edge.patch);
  }
  std::vector<bool> visited(graph.patches.size(), false);
  std::vector<bool> segment_visited(patches_of.size(), false);
  for (std::uint32_t start = 0; start < visited.size(); ++start) {
    if (visited[start]) continue;
    std::vector<std::uint32_t> component{start};
    visited[start] = true;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const std::uint32_t segment : segments_of[component[next]]) {
        if (segment_visited[segment]) continue;
        segment_visited[segment] = true;
        for (const std::uint32_t patch : patches_of[segment]) {
          if (visited[patch]) continue;
          visited[patch] = true;
          component.push_back(patch);
        }
      }
    }
    joinComponent(graph, component, table, events);
  }
}

}  // namespace

RegionMerger::Outcome ThesisMerger::merge(const MergeInput& input, RegionTable& table,
                                          const LabelingParams& params) {
  Outcome outcome;
  const SegmentMap& segments = input.segments;
  std::vector<RegionId> projected(input.view.fragments.size());
  std::ranges::transform(input.view.fragments, projected.begin(),
                         [&](FragmentId fragment) { return table.regionOf(fragment); });
  const RegionOverlaps graph = buildOverlapGraph<RegionId>(segments, projected);
  std::vector<FragmentId> fragment_of_patch;
  for (const RegionId region : graph.patches) fragment_of_patch.push_back(table.fragmentsOf(region).front());
  joinComponents(graph, params.overlap_threshold, table, outcome.events);

  // Each segment takes its largest qualifying overlap; all qualifying ones are in one region by now.
  std::vector<FragmentId> fragment_of_segment(segments.areas.size());
  std::vector<int> largest_overlap_px(segments.areas.size(), 0);
  for (const RegionOverlaps::Edge& edge : graph.edges) {
    if (edge.overlap_px <= largest_overlap_px[edge.segment]) continue;
    if (!graph.qualifies(edge, params.overlap_threshold)) continue;
    largest_overlap_px[edge.segment] = edge.overlap_px;
    const RegionId region = table.regionOf(fragment_of_patch[edge.patch]);
    fragment_of_segment[edge.segment] = table.fragmentsOf(region).front();
  }
  for (std::size_t segment = 1; segment < fragment_of_segment.size(); ++segment) {
    if (!fragment_of_segment[segment]) fragment_of_segment[segment] = table.newFragment();
  }

  outcome.fragments = input.view.fragments;
  outcome.regions.resize(outcome.fragments.size());
  for (std::size_t pixel = 0; pixel < outcome.fragments.size(); ++pixel) {
    FragmentId& fragment = outcome.fragments[pixel];
    const FragmentId merged = fragment_of_segment[segments.ids[pixel]];
    // A voxel of the region keeps its fragment.
    if (merged && table.regionOf(fragment) != table.regionOf(merged)) fragment = merged;
    outcome.regions[pixel] = table.regionOf(fragment);
  }
  return outcome;
}

}  // namespace scantrove
