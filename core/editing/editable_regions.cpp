#include "core/editing/editable_regions.h"

#include <algorithm>
#include <map>

namespace scantrove {
namespace {

/// Fewer voxels are below the resolution of registration and map.
constexpr std::size_t kFewVoxels = 12;

/// The voxels of one fragment in each part.
using VoxelsOfParts = std::vector<std::vector<Eigen::Vector3i>>;

/// The part with most of them. It keeps the fragment, and so what the graph does not have of it.
std::size_t largestPart(const VoxelsOfParts& voxels) {
  return static_cast<std::size_t>(std::ranges::max_element(voxels, {}, &std::vector<Eigen::Vector3i>::size) -
                                  voxels.begin());
}

/// The part that keeps each fragment: the largest; the first if the fragment has surface elsewhere, because a
/// graph holds only what is connected with the given places.
std::map<FragmentId, std::size_t> keepersOf(const std::map<FragmentId, VoxelsOfParts>& voxels,
                                            EditableMap& map) {
  std::map<FragmentId, std::size_t> keepers;
  EditableRegions::Fragments open;
  for (const auto& [fragment, of_parts] : voxels) {
    keepers[fragment] = largestPart(of_parts);
    if (keepers[fragment] != 0) open.push_back(fragment);
  }
  if (open.empty()) return keepers;
  std::map<FragmentId, std::size_t> all;
  for (const SurfaceVoxel& voxel : map.surfaceOf(open, {})) ++all[voxel.fragment];
  for (const FragmentId fragment : open) {
    std::size_t in_graph = 0;
    for (const auto& part : voxels.at(fragment)) in_graph += part.size();
    if (all[fragment] >= in_graph + kFewVoxels) keepers[fragment] = 0;
  }
  return keepers;
}

}  // namespace

EditableRegions::Division EditableRegions::divideVoxels(RegionId region, const SurfaceGraph& graph,
                                                        std::span<const std::uint32_t> part,
                                                        std::size_t parts) {
  std::map<FragmentId, VoxelsOfParts> voxels;
  for (std::size_t i = 0; i < graph.voxels.size(); ++i) {
    auto& of_fragment = voxels[graph.voxels[i].fragment];
    of_fragment.resize(parts);
    of_fragment[part[i]].push_back(graph.voxels[i].voxel);
  }
  const std::map<FragmentId, std::size_t> keepers = keepersOf(voxels, map_);
  Division division{std::vector<Fragments>(parts), {}};
  const auto of_region = table_.fragmentsOf(region);
  const Fragments members(of_region.begin(), of_region.end());
  for (const FragmentId fragment : members) {
    const auto found = voxels.find(fragment);
    if (found == voxels.end()) {
      division.parts.front().push_back(fragment);  // not at the surface, or far from the given places
      continue;
    }
    const std::size_t keeper = keepers.at(fragment);
    for (std::size_t p = 0; p < parts; ++p) {
      if (found->second[p].empty() && p != keeper) continue;
      const FragmentId target = p == keeper ? fragment : table_.newFragmentBeside(fragment);
      if (p != keeper) {
        map_.relabel(found->second[p], target);
        log_.splitOff(target, fragment);
        division.divided.emplace_back(target, fragment);
      }
      division.parts[p].push_back(target);
    }
  }
  std::erase_if(division.parts, [](const Fragments& of_part) { return of_part.empty(); });
  return division;
}

void EditableRegions::keepApart(std::span<const FragmentId> one, std::span<const FragmentId> other,
                                OperationEffect& effect) {
  constrain(largestOf(one), largestOf(other), LinkConstraint::cannot_link, effect);
  for (const FragmentId a : one) {
    for (const FragmentId b : merger_.neighborsOf(a)) {
      if (std::ranges::find(other, b) != other.end()) constrain(a, b, LinkConstraint::cannot_link, effect);
    }
  }
}

void EditableRegions::constrain(FragmentId a, FragmentId b, LinkConstraint constraint,
                                OperationEffect& effect) {
  const LinkConstraint before = merger_.constraintBetween(a, b);
  merger_.constrain(a, b, constraint);
  if (before != constraint) effect.constraints.push_back({a, b, before, constraint});
}

int EditableRegions::voxelsOf(FragmentId fragment) const {
  const auto voxels = map_.voxelsOfFragments();
  return fragment.value < voxels.size() ? voxels[fragment.value] : 0;
}

FragmentId EditableRegions::largestOf(std::span<const FragmentId> fragments) const {
  return *std::ranges::max_element(fragments, {}, [this](FragmentId one) { return voxelsOf(one); });
}

}  // namespace scantrove
