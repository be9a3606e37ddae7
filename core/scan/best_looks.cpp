#include "core/scan/best_looks.h"

#include <algorithm>

namespace scantrove {

void BestLooks::add(int frame_index, std::span<const Candidate> candidates) {
  for (const Candidate& candidate : candidates) {
    if (!candidate.wholeness) continue;
    const auto [entry, is_new] =
        best_.try_emplace(candidate.regions, Look{*candidate.wholeness, frame_index});
    if (!is_new && *candidate.wholeness > entry->second.wholeness)
      entry->second = {*candidate.wholeness, frame_index};
  }
}

std::vector<BestLooks::Best> BestLooks::disjoint(float least_wholeness) const {
  std::vector<Best> likely;
  for (const auto& [regions, look] : best_) {
    if (look.wholeness >= least_wholeness) likely.push_back({regions, look.wholeness, look.frame_index});
  }
  std::ranges::stable_sort(likely, std::ranges::greater(), &Best::wholeness);
  std::vector<Best> chosen;
  for (Best& best : likely) {
    if (std::ranges::none_of(chosen, [&](const Best& other) { return best.regions.overlaps(other.regions); }))
      chosen.push_back(std::move(best));
  }
  return chosen;
}

bool BestLooks::isUnlikely(RegionId region, float least_wholeness) const {
  return best_.contains(RegionSet{region}) && std::ranges::none_of(best_, [&](const auto& entry) {
           return entry.second.wholeness >= least_wholeness && entry.first.contains(region);
         });
}

}  // namespace scantrove
