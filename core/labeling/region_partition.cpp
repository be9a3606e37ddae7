#include "core/labeling/region_partition.h"

#include <algorithm>
#include <limits>

#include "core/labeling/greedy_contraction.h"

namespace scantrove {
namespace {

/// Fragments of all regions that one of `touched` belongs to, rising.
std::vector<FragmentId> membersOfTouched(std::span<const FragmentId> touched, const RegionTable& table) {
  std::vector<RegionId> regions;
  for (const FragmentId fragment : touched) regions.push_back(table.regionOf(fragment));
  std::ranges::sort(regions);
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::vector<FragmentId> members;
  for (const RegionId region : regions) {
    const auto fragments = table.fragmentsOf(region);
    members.insert(members.end(), fragments.begin(), fragments.end());
  }
  std::ranges::sort(members);
  return members;
}

class Divider {
 public:
  Divider(std::vector<FragmentId> members, const EvidenceGraph& graph, std::span<const int> voxels)
      : members_(std::move(members)), graph_(graph), voxels_(voxels) {}

  [[nodiscard]] std::vector<std::vector<FragmentId>> divide(const RegionTable& table,
                                                            const LabelingParams& params) {
    std::vector<WeightedEdge> edges;
    for (std::uint32_t a = 0; a < members_.size(); ++a) {
      for (const EvidenceGraph::Link& link : graph_.linksOf(members_[a])) {
        if (link.other < members_[a]) continue;
        const std::uint32_t b = indexOf(link.other);
        if (b == kOutside) continue;
        const BorderEvidence& border = graph_.border(link.border);
        const bool decided = border.constraint != BorderEvidence::Constraint::none;
        if (!decided && (isSliver(members_[a]) || isSliver(link.other))) continue;
        const bool are_one = table.regionOf(members_[a]) == table.regionOf(link.other);
        const float bias = params.joining_bias + (are_one ? params.hysteresis : -params.hysteresis);
        edges.push_back({a, b, border.weight(voxelsOf(members_[a]), voxelsOf(link.other), bias)});
      }
    }
    std::vector<std::uint32_t> part = contractGreedily(members_.size(), edges);
    attachSlivers(part);
    std::vector<std::vector<FragmentId>> parts(members_.size());
    for (std::size_t i = 0; i < members_.size(); ++i) parts[part[i]].push_back(members_[i]);
    std::erase_if(parts, [](const auto& fragments) { return fragments.empty(); });
    return parts;
  }

 private:
  static constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] std::uint32_t indexOf(FragmentId fragment) const {
    const auto found = std::ranges::lower_bound(members_, fragment);
    if (found == members_.end() || *found != fragment) return kOutside;
    return static_cast<std::uint32_t>(found - members_.begin());
  }
  [[nodiscard]] int voxelsOf(FragmentId fragment) const {
    return fragment.value < voxels_.size() ? voxels_[fragment.value] : 0;
  }
  [[nodiscard]] bool isSliver(FragmentId fragment) const { return voxelsOf(fragment) < kSliverVoxels; }

  /// Slivers beside something take its part; those beside slivers only stay what they are.
  void attachSlivers(std::vector<std::uint32_t>& part) const {
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      if (!isSliver(members_[i])) continue;
      float longest_m = 0;
      for (const EvidenceGraph::Link& link : graph_.linksOf(members_[i])) {
        const std::uint32_t other = indexOf(link.other);
        const BorderEvidence& border = graph_.border(link.border);
        if (other == kOutside || isSliver(link.other) || border.length_m <= longest_m) continue;
        if (border.constraint == BorderEvidence::Constraint::cannot_link) continue;
        longest_m = border.length_m;
        part[i] = part[other];
      }
    }
  }

  std::vector<FragmentId> members_;
  const EvidenceGraph& graph_;
  std::span<const int> voxels_;
};

}  // namespace

void updatePartition(std::span<const FragmentId> touched, const EvidenceGraph& graph,
                     std::span<const int> voxels, const LabelingParams& params, RegionTable& table,
                     RegionEvents& events) {
  std::vector<FragmentId> members = membersOfTouched(touched, table);
  if (members.size() < 2) return;
  table.divide(Divider(std::move(members), graph, voxels).divide(table, params), voxels, events);
}

}  // namespace scantrove
