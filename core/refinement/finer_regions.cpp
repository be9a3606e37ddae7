#include "core/refinement/finer_regions.h"

#include <algorithm>
#include <set>
#include <vector>

namespace scantrove {
namespace {

/// Log-odds by which each border has less evidence for joining.
constexpr float kLess = 4;

using Fragments = std::vector<FragmentId>;

/// Forbids joins across the borders between the two.
void keepApart(const Fragments& one, const Fragments& other, RegionMerger& merger) {
  for (const FragmentId a : one) {
    for (const FragmentId b : merger.neighborsOf(a)) {
      if (std::ranges::binary_search(other, b)) merger.mustBeApart(a, b);
    }
  }
}

}  // namespace

FinerRegions::FinerRegions(const RegionTable& table, const RegionMerger& merger, std::span<const int> voxels,
                           const LabelingParams& params, const std::function<bool(RegionId)>& stays)
    : table_(table) {
  const std::set<RegionId> regions(table.regions().begin() + 1, table.regions().end());
  for (const RegionId region : regions) {
    if (!region || table.isKnown(region) || table.userLabel(region) != UserLabel::nothing || stays(region))
      continue;
    const std::vector<Fragments> parts = merger.partsOf(region, kLess, table, voxels, params);
    if (parts.size() < 2) continue;
    RegionEvents ignored;
    table_.divide(parts, voxels, ignored);
    for (const Fragments& part : parts) parts_[region].add(table_.regionOf(part.front()));
  }
}

bool FinerRegions::holdsPart(const RegionSet& finer) const {
  return std::ranges::any_of(parts_, [&](const auto& entry) { return finer.overlaps(entry.second); });
}

RegionSet FinerRegions::partsOf(const RegionSet& regions) const {
  RegionSet all;
  for (const RegionId region : regions) {
    const auto found = parts_.find(region);
    all.add(found == parts_.end() ? RegionSet{region} : found->second);
  }
  return all;
}

std::vector<FragmentId> FinerRegions::fragmentsOf(const RegionSet& finer) const {
  Fragments all;
  for (const RegionId region : finer) std::ranges::copy(table_.fragmentsOf(region), std::back_inserter(all));
  return all;
}

void FinerRegions::apply(std::span<const RegionSet> complete, RegionTable& table, RegionMerger& merger,
                         std::span<const int> voxels, RegionEvents& events) const {
  std::map<RegionId, std::vector<Fragments>> parts;
  for (const RegionSet& set : complete) {
    std::map<RegionId, Fragments> of_region;
    for (const FragmentId fragment : fragmentsOf(set))
      of_region[table.regionOf(fragment)].push_back(fragment);
    for (auto& [region, fragments] : of_region) {
      std::ranges::sort(fragments);
      parts[region].push_back(std::move(fragments));
    }
  }
  for (auto& [region, of_region] : parts) {
    if (!parts_.contains(region)) continue;
    Fragments rest;
    for (const FragmentId fragment : table.fragmentsOf(region)) {
      const auto holds = [&](const Fragments& part) { return std::ranges::binary_search(part, fragment); };
      if (std::ranges::none_of(of_region, holds)) rest.push_back(fragment);
    }
    if (!rest.empty()) of_region.push_back(std::move(rest));
    if (of_region.size() < 2) continue;
    table.divide(of_region, voxels, events);
    for (std::size_t i = 0; i < of_region.size(); ++i) {
      for (std::size_t j = i + 1; j < of_region.size(); ++j) keepApart(of_region[i], of_region[j], merger);
    }
  }
}

std::optional<RegionSet> FinerRegions::regionsOf(const RegionSet& finer, const RegionTable& table) const {
  const Fragments fragments = fragmentsOf(finer);
  RegionSet regions;
  for (const FragmentId fragment : fragments) regions.add(table.regionOf(fragment));
  std::size_t all = 0;
  for (const RegionId region : regions) all += table.fragmentsOf(region).size();
  if (all != fragments.size()) return std::nullopt;
  return regions;
}

}  // namespace scantrove
