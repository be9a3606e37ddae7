#include "core/refinement/collector_input.h"

#include <algorithm>

#include "core/discovery/region_candidate.h"

namespace scantrove {

void leaveOutRejected(const ObjectCollector& collector, const RegionNotes& notes,
                      std::vector<Candidate>& candidates) {
  if (notes.all().empty()) return;
  std::erase_if(candidates, [&](const Candidate& candidate) {
    const bool is_set = candidate.regions.size() > 1;
    const bool is_one = is_set && collector.tracks().areOneObject(candidate.regions);
    return std::ranges::any_of(candidate.regions, [&](RegionId region) {
      const RegionNote& note = notes.of(region);
      return note.background || note.rejected || (is_set && !is_one && !note.name.empty());
    });
  });
}

std::vector<Candidate> candidatesFor(ObjectCollector& collector, const FrameResult& result,
                                     const RegionNotes& notes, int least_points) {
  collector.tracks().setRegionsInView(result.regions_in_view);
  std::vector<Candidate> candidates = result.candidates;
  leaveOutRejected(collector, notes, candidates);
  if (collector.requests().pending().empty()) return candidates;
  const std::vector<RegionId> shown = result.shownRegions();
  addRequested(collector, result.inputFor(shown), least_points, candidates);
  return candidates;
}

void addRequested(const ObjectCollector& collector, const DiscoveryInput& input, int least_points,
                  std::vector<Candidate>& candidates) {
  const auto least_here = static_cast<int>(least_points * input.view.K.pixelScale());
  for (const auto& [region, given] : collector.requests().pending()) {
    // A name applies to the region alone; a click may mean a set that contains it.
    const bool is_found =
        std::ranges::any_of(candidates, [one = region, is_any = given.name.empty()](const Candidate& other) {
          return other.regions == RegionSet{one} || (is_any && other.regions.contains(one));
        });
    if (is_found) continue;
    if (std::optional<Candidate> candidate = candidateOf(region, input, least_here))
      candidates.push_back(std::move(*candidate));
  }
}

void applyRegionEvents(ObjectCollector& collector, const RegionEvents& events, ObjectCollector::JoinedBy by,
                       int operation) {
  for (const auto& [into, from] : events.joined) collector.joinRegions(into, from, by, operation);
  for (const auto& [from, part] : events.parted) collector.splitRegion(from, part);
}

}  // namespace scantrove
