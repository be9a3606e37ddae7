#include "core/discovery/size_history.h"

#include <algorithm>

namespace scantrove {

void SizeHistory::add(std::span<const Sighting> sightings, int frames) {
  std::map<RegionSet, std::vector<float>> now;
  for (const Sighting& sighting : sightings) {
    std::vector<float> areas;
    if (const auto before = areas_.find(sighting.regions); before != areas_.end())
      areas = std::move(before->second);
    areas.push_back(sighting.visible_area_m2);
    const auto limit = static_cast<std::size_t>(std::max(frames, 1));
    if (areas.size() > limit) areas.erase(areas.begin(), areas.end() - static_cast<std::ptrdiff_t>(limit));
    now.emplace(sighting.regions, std::move(areas));
  }
  areas_ = std::move(now);
}

bool SizeHistory::isPersistent(const RegionSet& regions, int frames, float tolerance) const {
  const auto found = areas_.find(regions);
  if (found == areas_.end() || static_cast<int>(found->second.size()) < frames) return false;
  const auto [smallest, largest] = std::ranges::minmax(found->second);
  return largest > 0 && largest - smallest <= tolerance * largest;
}

void SizeHistory::joinRegions(RegionId into, RegionId from) {
  std::vector<std::pair<RegionSet, std::vector<float>>> changed;
  for (auto entry = areas_.begin(); entry != areas_.end();) {
    if (!entry->first.contains(from)) {
      ++entry;
      continue;
    }
    changed.emplace_back(entry->first, std::move(entry->second));
    changed.back().first.join(into, from);
    entry = areas_.erase(entry);
  }
  for (auto& [regions, areas] : changed) areas_.try_emplace(std::move(regions), std::move(areas));
}

}  // namespace scantrove
