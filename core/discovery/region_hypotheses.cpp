#include "core/discovery/region_hypotheses.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/discovery/region_points.h"
#include "core/discovery/region_rules.h"

namespace scantrove {
namespace {

constexpr float kMinContactPart = 0.1F;  // of the outline of one of them
constexpr float kMinRimPart = 0.2F;      // of a concave region's outline

/// An object's outside is about as wide as its inside, or wider; an object standing in a plate is not.
bool couldHold(const RegionExtent& outside, const RegionExtent& inner) {
  constexpr float kWider = 1.2F;  // noise, and a rim seen at an angle
  const auto longest = [](const cv::Rect& box) {
    return static_cast<float>(std::max(box.width, box.height));
  };
  return longest(inner.box_px) <= kWider * longest(outside.box_px);
}

/// The pairs of regions that could be one object.
class Neighborhood {
 public:
  struct Neighbor {
    RegionId region;
    float odds = 0;
  };

  Neighborhood(std::span<const RegionExtent> regions, const RegionOutlines& outlines,
               const DiscoveryInput& input, const DiscoveryParams& params)
      : outlines_(outlines) {
    if (!input.joining_odds) return;
    std::set<RegionId> concave;
    for (const RegionExtent& extent : regions) {
      if (isConcave(bulgeOf({extent.region}, extent.box_px, input), params)) concave.insert(extent.region);
    }
    for (const RegionExtent& extent : regions) {
      const RegionId a = extent.region;
      for (const RegionId b : outlines.touchedBy(a, kMinContact)) {
        const auto found = std::ranges::lower_bound(regions, b, {}, &RegionExtent::region);
        if (b < a || found == regions.end() || found->region != b) continue;
        const bool is_a_in_b =
            concave.contains(a) && !concave.contains(b) && isRim(a, b) && couldHold(*found, extent);
        const bool is_b_in_a =
            concave.contains(b) && !concave.contains(a) && isRim(b, a) && couldHold(extent, *found);
        const bool is_rim = is_a_in_b || is_b_in_a;
        if (!(is_rim || isContact(a, b) || isContact(b, a))) continue;
        float odds = input.joining_odds(a, b);
        if (is_rim) odds = std::max(odds, -kNearOdds);  // no contact is visible over a rim
        if (!(odds >= -kNearOdds)) continue;
        neighbors_[a].push_back({b, odds});
        neighbors_[b].push_back({a, odds});
        if (is_a_in_b) noteInside(a, b);
        if (is_b_in_a) noteInside(b, a);
      }
    }
  }

  [[nodiscard]] std::span<const Neighbor> of(RegionId region) const {
    const auto found = neighbors_.find(region);
    return found == neighbors_.end() ? std::span<const Neighbor>() : found->second;
  }
  [[nodiscard]] bool hasInconsistentOutline(const RegionSet& regions) const {
    return std::ranges::any_of(insides_, [&](const auto& inside) {
      return regions.contains(inside.first) != regions.contains(inside.second);
    });
  }

 private:
  [[nodiscard]] bool isContact(RegionId of, RegionId with) const {
    const int touching = outlines_.between(of, with).touching();
    return touching >= kMinContact && static_cast<float>(touching) >= kMinContactPart * lengthOf(of);
  }
  [[nodiscard]] bool isRim(RegionId inner, RegionId with) const {
    return static_cast<float>(outlines_.between(inner, with).known()) >= kMinRimPart * lengthOf(inner);
  }
  [[nodiscard]] float lengthOf(RegionId region) const {
    return static_cast<float>(outlines_.of({region}).known());
  }
  /// A concave region is the inside of the region with the longest common rim.
  void noteInside(RegionId inner, RegionId outside) {
    const auto [inside, is_first] = insides_.try_emplace(inner, outside);
    if (!is_first &&
        outlines_.between(inner, outside).known() > outlines_.between(inner, inside->second).known())
      inside->second = outside;
  }

  const RegionOutlines& outlines_;
  std::map<RegionId, std::vector<Neighbor>> neighbors_;
  std::map<RegionId, RegionId> insides_;  // concave regions, and their outsides
};

}  // namespace

std::vector<RegionHypothesis> proposeHypotheses(std::span<const RegionExtent> regions,
                                                const RegionOutlines& outlines, const DiscoveryInput& input,
                                                const DiscoveryParams& params) {
  std::vector<RegionHypothesis> hypotheses;
  for (const RegionExtent& extent : regions)
    hypotheses.push_back({{extent.region}, extent, visibleArea(extent, input)});
  const Neighborhood neighborhood(regions, outlines, input, params);
  // Extends the existing sets by one region, each result once.
  std::set<RegionSet> known;
  for (std::size_t i = 0; i < hypotheses.size() && hypotheses.size() < regions.size() + kMaxSets; ++i) {
    if (hypotheses[i].regions.size() == kMaxRegions) break;
    for (const RegionId member : RegionSet(hypotheses[i].regions)) {
      for (const auto& [other, odds] : neighborhood.of(member)) {
        RegionSet larger = hypotheses[i].regions;
        larger.add(other);
        if (larger.size() == hypotheses[i].regions.size() || !known.insert(larger).second) continue;
        RegionHypothesis hypothesis = hypotheses[i];
        const auto added = std::ranges::find(regions, other, &RegionExtent::region);
        hypothesis.extent.add(*added);
        hypothesis.visible_area_m2 +=
            hypotheses[static_cast<std::size_t>(added - regions.begin())].visible_area_m2;
        hypothesis.odds = std::min(hypothesis.odds, odds);
        hypothesis.regions = std::move(larger);
        hypotheses.push_back(std::move(hypothesis));
      }
    }
  }
  for (RegionHypothesis& hypothesis : hypotheses)
    hypothesis.is_inconsistent = neighborhood.hasInconsistentOutline(hypothesis.regions);
  std::ranges::sort(hypotheses, {}, &RegionHypothesis::regions);
  return hypotheses;
}

}  // namespace scantrove
