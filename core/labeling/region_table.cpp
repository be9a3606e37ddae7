#include "core/labeling/region_table.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "core/base/check.h"

namespace scantrove {

FragmentId RegionTable::newFragment() {
  const FragmentId fragment = takeNumber();
  assign(newRegion(), {fragment});
  ++version_;
  return fragment;
}

FragmentId RegionTable::newFragmentBeside(FragmentId fragment) {
  const FragmentId cut = takeNumber();
  const RegionId region = regionOf(fragment);
  std::vector<FragmentId> members = members_.at(region).fragments;
  members.insert(std::ranges::upper_bound(members, cut), cut);
  seen_from_[cut.value] = seen_from_[fragment.value];
  assign(region, std::move(members));
  ++version_;
  return cut;
}

FragmentId RegionTable::takeNumber() {
  FragmentId fragment;
  if (free_.empty()) {
    fragment.value = static_cast<std::uint32_t>(regions_.size());
    regions_.emplace_back();
    seen_from_.emplace_back();
    support_pixels_.emplace_back();
  } else {
    fragment = free_.back();
    free_.pop_back();
    seen_from_[fragment.value] = {};
    support_pixels_[fragment.value] = {};
  }
  return fragment;
}

void RegionTable::free(FragmentId fragment) {
  const RegionId region = regions_.at(fragment.value);
  if (!fragment || !region) return;
  std::vector<FragmentId>& members = members_.at(region).fragments;
  std::erase(members, fragment);
  if (members.empty()) members_.erase(region);
  setRegion(fragment, {});
  free_.insert(std::lower_bound(free_.begin(), free_.end(), fragment, std::greater<>()), fragment);
  ++version_;
}

std::span<const FragmentId> RegionTable::fragmentsOf(RegionId region) const {
  const auto found = members_.find(region);
  if (found == members_.end()) return {};
  return found->second.fragments;
}

ViewCoverage RegionTable::seenFrom(FragmentId fragment) const {
  return fragment.value < seen_from_.size() ? seen_from_[fragment.value] : ViewCoverage{};
}

ViewCoverage RegionTable::seenFrom(RegionId region) const {
  ViewCoverage all;
  for (const FragmentId fragment : fragmentsOf(region)) all.add(seenFrom(fragment));
  return all;
}

SupportPixels RegionTable::supportPixels(FragmentId fragment) const {
  return fragment.value < support_pixels_.size() ? support_pixels_[fragment.value] : SupportPixels{};
}

SupportPixels RegionTable::supportPixels(RegionId region) const {
  SupportPixels all;
  for (const FragmentId fragment : fragmentsOf(region)) all += supportPixels(fragment);
  return all;
}

void RegionTable::setKnown(RegionId region, bool known) {
  if (const auto found = members_.find(region); found != members_.end()) found->second.known = known;
}

bool RegionTable::isKnown(RegionId region) const {
  const auto found = members_.find(region);
  return found != members_.end() && found->second.known;
}

void RegionTable::setUserLabel(RegionId region, UserLabel label) {
  if (const auto found = members_.find(region); found != members_.end()) found->second.label = label;
}

UserLabel RegionTable::userLabel(RegionId region) const {
  const auto found = members_.find(region);
  return found == members_.end() ? UserLabel::nothing : found->second.label;
}

RegionId RegionTable::newRegion() {
  const RegionId region{++last_region_};
  members_[region];
  return region;
}

void RegionTable::assign(RegionId region, std::vector<FragmentId> fragments) {
  for (const FragmentId fragment : fragments) setRegion(fragment, region);
  members_[region].fragments = std::move(fragments);
}

void RegionTable::setRegion(FragmentId fragment, RegionId region) {
  if (regions_[fragment.value] == region) return;
  regions_[fragment.value] = region;
  for (Changes& changes : changes_) {
    changes.is_listed.resize(regions_.size(), false);
    if (changes.is_listed[fragment.value]) continue;
    changes.is_listed[fragment.value] = true;
    changes.fragments.push_back(fragment);
  }
}

std::vector<FragmentId> RegionTable::takeChanged(Reader reader) {
  Changes& changes = changes_[static_cast<std::size_t>(reader)];
  for (const FragmentId fragment : changes.fragments) changes.is_listed[fragment.value] = false;
  return std::exchange(changes.fragments, {});
}

void RegionTable::restore(std::vector<RegionId> regions, RegionId last_region) {
  if (regions.empty()) regions.emplace_back();
  *this = RegionTable();
  regions_.resize(regions.size());
  seen_from_.resize(regions.size());
  support_pixels_.resize(regions.size());
  last_region_ = last_region.value;
  for (auto number = static_cast<std::uint32_t>(regions.size()); number-- > 1;) {
    const FragmentId fragment{number};
    if (!regions[number]) {
      free_.push_back(fragment);  // the lowest last
      continue;
    }
    setRegion(fragment, regions[number]);
    std::vector<FragmentId>& members = members_[regions[number]].fragments;
    members.insert(members.begin(), fragment);
    last_region_ = std::max(last_region_, regions[number].value);
  }
  ++version_;
}

bool RegionTable::join(RegionId into, RegionId from) {
  if (into == from || !members_.contains(into) || !members_.contains(from)) return false;
  std::vector<FragmentId> all;
  std::ranges::merge(members_[into].fragments, members_[from].fragments, std::back_inserter(all));
  const bool known = members_[into].known || members_[from].known;
  members_.erase(from);
  assign(into, std::move(all));
  members_[into].known = known;
  ++version_;
  return true;
}

void RegionTable::move(std::span<const RegionMove> moves, RegionEvents& events) {
  std::map<RegionId, RegionId> emptied;  // into
  for (const auto& [fragment, before, after] : moves) {
    if (fragment.value >= regions_.size() || !before || !after || regionOf(fragment) != before) continue;
    std::vector<FragmentId>& from = members_.at(before).fragments;
    std::erase(from, fragment);
    if (from.empty()) emptied[before] = after;
    const auto [into, is_back] = members_.try_emplace(after);
    if (is_back) events.parted.emplace_back(before, after);
    std::vector<FragmentId>& to = into->second.fragments;
    to.insert(std::ranges::upper_bound(to, fragment), fragment);
    emptied.erase(after);
    setRegion(fragment, after);
    ++version_;
  }
  for (const auto& [region, into] : emptied) {
    members_.erase(region);
    events.joined.emplace_back(into, region);
  }
}

RegionId RegionTable::separate(std::span<const FragmentId> fragments, RegionEvents& events) {
  SCANTROVE_CHECK(!fragments.empty());
  const RegionId part{++last_region_};
  std::vector<RegionMove> moves;
  for (const FragmentId fragment : fragments) moves.push_back({fragment, regionOf(fragment), part});
  move(moves, events);
  return part;
}

void RegionTable::divide(const std::vector<std::vector<FragmentId>>& parts, std::span<const int> voxels,
                         RegionEvents& events) {
  // Claims of parts on identities, the strongest first; ties in the order of parts and regions.
  struct Claim {
    int strength;
    std::int64_t voxels;
    std::size_t part;
    RegionId region;
  };
  const auto strengthOf = [this](RegionId region) {
    return userLabel(region) != UserLabel::nothing ? 2 : isKnown(region) ? 1 : 0;
  };
  std::vector<Claim> claims;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    std::map<RegionId, std::int64_t> given;
    for (const FragmentId fragment : parts[part]) {
      const bool counted = fragment.value < voxels.size();
      given[regionOf(fragment)] += counted ? std::max(voxels[fragment.value], 1) : 1;
    }
    for (const auto& [region, count] : given) claims.push_back({strengthOf(region), count, part, region});
  }
  std::ranges::stable_sort(claims, [](const Claim& a, const Claim& b) {
    return std::tie(a.strength, a.voxels) > std::tie(b.strength, b.voxels);
  });
  std::vector<RegionId> identity(parts.size());
  std::map<RegionId, std::size_t> keeper;  // of each region: the part that keeps its identity
  for (const Claim& claim : claims) {
    if (identity[claim.part] || keeper.contains(claim.region)) continue;
    identity[claim.part] = claim.region;
    keeper[claim.region] = claim.part;
  }
  // A part without identity is new; it was split from the region with most voxels in it. A region without a
  // part that keeps its identity was joined into the part with most of its voxels.
  bool changed = false;
  std::map<RegionId, RegionId> joined_into;
  for (const Claim& claim : claims) {
    if (!identity[claim.part]) {
      identity[claim.part] = newRegion();
      events.parted.emplace_back(claim.region, identity[claim.part]);
      changed = true;
    }
    if (!keeper.contains(claim.region)) joined_into.try_emplace(claim.region, identity[claim.part]);
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    std::vector<FragmentId> fragments = parts[part];
    std::ranges::sort(fragments);
    if (members_.at(identity[part]).fragments == fragments) continue;
    assign(identity[part], std::move(fragments));
    changed = true;
  }
  for (const auto& [from, into] : joined_into) {
    members_.erase(from);
    events.joined.emplace_back(into, from);
  }
  if (changed || !joined_into.empty()) ++version_;
}

}  // namespace scantrove
