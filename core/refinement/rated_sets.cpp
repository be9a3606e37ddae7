#include "core/refinement/rated_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace scantrove {
namespace {

constexpr std::size_t kObservations = 8;
// On random scenes outside the judge's training data, 0.66 of the selected sets above 0.4 m were complete,
// and 0.87 of smaller ones; with this it is 0.80, with as many found.
constexpr float kLargeFrom_m = 0.3F;
constexpr float kLessOfLarge = 2;  // subtracted for each factor e of size

}  // namespace

bool RatedSets::Observation::isBetterThan(const Observation& other) const {
  return is_cut_off != other.is_cut_off ? other.is_cut_off : objectness > other.objectness;
}

float RatedSets::Observations::together() const {
  const float less = kLessOfLarge * std::log(std::max(longest_m / kLargeFrom_m, 1.0F));
  return std::accumulate(best.begin(), best.end(), 0.0F) / static_cast<float>(best.size() + 1) - less;
}

void RatedSets::add(int frame_index, std::span<const Candidate> candidates) {
  for (const Candidate& candidate : candidates) {
    if (!candidate.objectness) continue;
    Observations& observations = observations_[candidate.regions];
    const Observation observation{candidate.is_cut_off, *candidate.objectness, frame_index};
    if (!observations.to_show || observation.isBetterThan(*observations.to_show))
      observations.to_show = observation;
    observations.best.insert(
        std::ranges::lower_bound(observations.best, *candidate.objectness, std::greater<>()),
        *candidate.objectness);
    if (observations.best.size() > kObservations) observations.best.pop_back();
    observations.longest_m = std::max(observations.longest_m, candidate.size_m[0]);
  }
}

std::vector<RatedSets::Rated> RatedSets::disjoint(float least_objectness) const {
  std::vector<Rated> likely;
  for (const auto& [regions, observations] : observations_) {
    const float objectness = observations.together();
    if (objectness >= least_objectness)
      likely.push_back({regions, objectness, observations.to_show->frame_index});
  }
  std::ranges::stable_sort(likely, std::greater<>(), &Rated::objectness);
  std::vector<Rated> chosen;
  for (Rated& rated : likely) {
    if (std::ranges::none_of(chosen,
                             [&](const Rated& other) { return rated.regions.overlaps(other.regions); }))
      chosen.push_back(std::move(rated));
  }
  return chosen;
}

std::map<RegionId, float> RatedSets::ofRegions(std::span<const Rated> complete) const {
  std::map<RegionId, float> objectness;
  for (const auto& [regions, observations] : observations_) {
    if (regions.size() == 1) objectness[*regions.begin()] = observations.together();
  }
  for (const Rated& set : complete) {
    for (const RegionId region : set.regions) objectness[region] = set.objectness;
  }
  return objectness;
}

void RatedSets::rename(const Rename& rename) {
  std::map<RegionSet, Observations> renamed;
  for (auto& [regions, observations] : observations_) {
    if (const std::optional<RegionSet> now = rename(regions)) renamed.emplace(*now, std::move(observations));
  }
  observations_ = std::move(renamed);
}

bool RatedSets::isUnlikely(RegionId region, float least_objectness) const {
  return observations_.contains(RegionSet{region}) &&
         std::ranges::none_of(observations_, [&](const auto& entry) {
           return entry.second.together() >= least_objectness && entry.first.contains(region);
         });
}

}  // namespace scantrove
