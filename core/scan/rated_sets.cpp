#include "core/scan/rated_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace scantrove {
namespace {

constexpr std::size_t kLooks = 8;
// On random scenes that the judge was not fitted to 0.66 of the sets above 0.4 m that it took were whole, and
// 0.87 of smaller ones; with this it is 0.80, and as much is found.
constexpr float kLargeFrom_m = 0.3F;
constexpr float kLessOfLarge = 2;  // for each e times as large

}  // namespace

bool RatedSets::Look::isBetterThan(const Look& other) const {
  return is_cut_off != other.is_cut_off ? other.is_cut_off : wholeness > other.wholeness;
}

float RatedSets::Looks::together() const {
  const float less = kLessOfLarge * std::log(std::max(longest_m / kLargeFrom_m, 1.0F));
  return std::accumulate(best.begin(), best.end(), 0.0F) / static_cast<float>(best.size() + 1) - less;
}

void RatedSets::add(int frame_index, std::span<const Candidate> candidates) {
  for (const Candidate& candidate : candidates) {
    if (!candidate.wholeness) continue;
    Looks& looks = looks_[candidate.regions];
    const Look look{candidate.is_cut_off, *candidate.wholeness, frame_index};
    if (!looks.to_show || look.isBetterThan(*looks.to_show)) looks.to_show = look;
    looks.best.insert(std::ranges::lower_bound(looks.best, *candidate.wholeness, std::greater<>()),
                      *candidate.wholeness);
    if (looks.best.size() > kLooks) looks.best.pop_back();
    looks.longest_m = std::max(looks.longest_m, candidate.size_m[0]);
  }
}

std::vector<RatedSets::Rated> RatedSets::disjoint(float least_wholeness) const {
  std::vector<Rated> likely;
  for (const auto& [regions, looks] : looks_) {
    const float wholeness = looks.together();
    if (wholeness >= least_wholeness) likely.push_back({regions, wholeness, looks.to_show->frame_index});
  }
  std::ranges::stable_sort(likely, std::greater<>(), &Rated::wholeness);
  std::vector<Rated> chosen;
  for (Rated& rated : likely) {
    if (std::ranges::none_of(chosen,
                             [&](const Rated& other) { return rated.regions.overlaps(other.regions); }))
      chosen.push_back(std::move(rated));
  }
  return chosen;
}

void RatedSets::rename(const Rename& rename) {
  std::map<RegionSet, Looks> renamed;
  for (auto& [regions, looks] : looks_) {
    if (const std::optional<RegionSet> now = rename(regions)) renamed.emplace(*now, std::move(looks));
  }
  looks_ = std::move(renamed);
}

bool RatedSets::isUnlikely(RegionId region, float least_wholeness) const {
  return looks_.contains(RegionSet{region}) && std::ranges::none_of(looks_, [&](const auto& entry) {
           return entry.second.together() >= least_wholeness && entry.first.contains(region);
         });
}

}  // namespace scantrove
