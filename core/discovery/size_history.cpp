#include "core/discovery/size_history.h"

#include <algorithm>

namespace scantrove {

void SizeHistory::add(std::span<const Sighting> sightings, int frames) {
  std::unordered_map<RegionId, std::vector<float>> now;
  now.reserve(sightings.size());
  for (const Sighting& sighting : sightings) {
    std::vector<float> areas;
    if (const auto before = areas_.find(sighting.region); before != areas_.end())
      areas = std::move(before->second);
    areas.push_back(sighting.visible_area_m2);
    const auto limit = static_cast<std::size_t>(std::max(frames, 1));
    if (areas.size() > limit) areas.erase(areas.begin(), areas.end() - static_cast<std::ptrdiff_t>(limit));
    now.emplace(sighting.region, std::move(areas));
  }
  areas_ = std::move(now);
}

bool SizeHistory::isPersistent(RegionId region, int frames, float tolerance) const {
  const auto found = areas_.find(region);
  if (found == areas_.end() || static_cast<int>(found->second.size()) < frames) return false;
  const auto [smallest, largest] = std::ranges::minmax(found->second);
  return largest > 0 && largest - smallest <= tolerance * largest;
}

void SizeHistory::merge(RegionId into, RegionId from) {
  const auto found = areas_.find(from);
  if (found == areas_.end() || into == from) return;
  std::vector<float> areas = std::move(found->second);
  areas_.erase(found);
  areas_.try_emplace(into, std::move(areas));
}

}  // namespace scantrove
