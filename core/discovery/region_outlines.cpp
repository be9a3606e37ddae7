#include "core/discovery/region_outlines.h"

#include <algorithm>

#include "core/base/check.h"

namespace scantrove {
template <class Visit>
void RegionOutlines::forEachBeyond(const RegionSet& regions, const Visit& visit) const {
  for (const RegionId region : regions) {
    const auto outline = outlines_.find(region);
    if (outline == outlines_.end()) continue;
    for (const Beyond& beyond : outline->second) {
      if (!regions.contains(beyond.region)) visit(beyond);
    }
  }
}

RegionOutlines::RegionOutlines(const DiscoveryInput& input) {
  const int width = input.view.K.width, height = input.view.K.height;
  SCANTROVE_CHECK(input.view.vertices_world.size() == input.regions.size());
  SCANTROVE_CHECK(input.view.normals_world.size() == input.regions.size());
  const OutlineStepJudge judge(input);
  RegionId last;
  std::vector<Beyond>* of_last = nullptr;
  const auto add = [&](RegionId from, RegionId to, OutlineEnd end) {
    if (!from) return;
    if (of_last == nullptr || from != last) of_last = &outlines_[from];
    last = from;
    std::vector<Beyond>& outline = *of_last;
    auto beyond = std::ranges::find(outline, to, &Beyond::region);
    if (beyond == outline.end()) beyond = outline.insert(outline.end(), {to, {}});
    ++(beyond->steps.*end);
  };
  const std::span<const RegionId> regions = input.regions;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const std::size_t here = input.view.K.indexOf(u, v);
      const RegionId region = regions[here];
      if (u == 0 || u + 1 == width) add(region, {}, &OutlineSteps::cut);
      if (v == 0 || v + 1 == height) add(region, {}, &OutlineSteps::cut);
      if (u + 1 < width && regions[here + 1] != region) {
        add(region, regions[here + 1], judge.judge(u, v, 1, 0));
        add(regions[here + 1], region, judge.judge(u + 1, v, -1, 0));
      }
      const std::size_t below = here + static_cast<std::size_t>(width);
      if (v + 1 < height && regions[below] != region) {
        add(region, regions[below], judge.judge(u, v, 0, 1));
        add(regions[below], region, judge.judge(u, v + 1, 0, -1));
      }
    }
  }
}

OutlineSteps RegionOutlines::of(const RegionSet& regions) const {
  OutlineSteps all;
  forEachBeyond(regions, [&all](const Beyond& beyond) { all += beyond.steps; });
  return all;
}

std::map<RegionId, OutlineSteps> RegionOutlines::beyond(const RegionSet& regions) const {
  std::map<RegionId, OutlineSteps> all;
  forEachBeyond(regions, [&all](const Beyond& beyond) { all[beyond.region] += beyond.steps; });
  return all;
}

OutlineSteps RegionOutlines::between(RegionId a, RegionId b) const {
  const auto outline = outlines_.find(a);
  if (outline == outlines_.end()) return {};
  const auto beyond = std::ranges::find(outline->second, b, &Beyond::region);
  return beyond == outline->second.end() ? OutlineSteps{} : beyond->steps;
}

std::vector<RegionId> RegionOutlines::touchedBy(RegionId region, int least_steps) const {
  std::vector<RegionId> neighbors;
  const auto outline = outlines_.find(region);
  if (outline == outlines_.end()) return neighbors;
  for (const Beyond& beyond : outline->second) {
    if (beyond.region && beyond.steps.known() >= least_steps) neighbors.push_back(beyond.region);
  }
  std::ranges::sort(neighbors);
  return neighbors;
}

}  // namespace scantrove
