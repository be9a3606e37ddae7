#include "core/discovery/region_hypotheses.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/discovery/region_points.h"

namespace scantrove {
namespace {

constexpr int kLeastContact = 4;           // steps along which two regions touch
constexpr float kLeastContactPart = 0.1F;  // of the outline of one of them

void include(const RegionExtent& other, RegionExtent& extent) {
  extent.pixels += other.pixels;
  extent.box_px |= other.box_px;
  extent.sum_u += other.sum_u;
  extent.sum_v += other.sum_v;
  extent.sum_uu += other.sum_uu;
  extent.sum_uv += other.sum_uv;
  extent.sum_vv += other.sum_vv;
}

struct Neighbour {
  RegionId region;
  float odds = 0;
};

/// Which regions could be one thing with which.
std::map<RegionId, std::vector<Neighbour>> neighboursOf(std::span<const RegionExtent> regions,
                                                        const RegionOutlines& outlines,
                                                        const DiscoveryInput& input) {
  std::map<RegionId, std::vector<Neighbour>> neighbours;
  if (!input.joining_odds) return neighbours;
  const auto isThere = [&](RegionId region) {
    return std::ranges::binary_search(regions, region, {}, &RegionExtent::region);
  };
  const auto isLong = [&](RegionId of, RegionId with) {
    return static_cast<float>(outlines.between(of, with).touching()) >=
           kLeastContactPart * static_cast<float>(outlines.of({of}).known());
  };
  for (const RegionExtent& extent : regions) {
    const RegionId a = extent.region;
    for (const RegionId b : outlines.touchedBy(a, kLeastContact)) {
      if (b < a || !isThere(b) || !(isLong(a, b) || isLong(b, a))) continue;
      const float odds = input.joining_odds(a, b);
      if (!(odds > -kNearOdds)) continue;
      neighbours[a].push_back({b, odds});
      neighbours[b].push_back({a, odds});
    }
  }
  return neighbours;
}

}  // namespace

std::vector<RegionHypothesis> proposeHypotheses(std::span<const RegionExtent> regions,
                                                const RegionOutlines& outlines, const DiscoveryInput& input) {
  std::vector<RegionHypothesis> hypotheses;
  for (const RegionExtent& extent : regions)
    hypotheses.push_back({{extent.region}, extent, visibleArea(extent, input)});
  const auto neighbours = neighboursOf(regions, outlines, input);
  // Sets of one region more are made of those that there are, each once.
  std::set<RegionSet> known;
  for (std::size_t i = 0; i < hypotheses.size() && hypotheses.size() < regions.size() + kMostSets; ++i) {
    if (hypotheses[i].regions.size() == kMostRegions) break;
    for (const RegionId member : RegionSet(hypotheses[i].regions)) {
      const auto around = neighbours.find(member);
      if (around == neighbours.end()) continue;
      for (const auto& [other, odds] : around->second) {
        RegionSet larger = hypotheses[i].regions;
        larger.add(other);
        if (larger.size() == hypotheses[i].regions.size() || !known.insert(larger).second) continue;
        RegionHypothesis hypothesis = hypotheses[i];
        const auto added = std::ranges::find(regions, other, &RegionExtent::region);
        include(*added, hypothesis.extent);
        hypothesis.visible_area_m2 +=
            hypotheses[static_cast<std::size_t>(added - regions.begin())].visible_area_m2;
        hypothesis.odds = std::min(hypothesis.odds, odds);
        hypothesis.regions = std::move(larger);
        hypotheses.push_back(std::move(hypothesis));
      }
    }
  }
  std::ranges::sort(hypotheses, {}, &RegionHypothesis::regions);
  return hypotheses;
}

}  // namespace scantrove
