#include "core/labeling/region_partition.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "core/labeling/greedy_contraction.h"

namespace scantrove {
namespace {

/// Fragments of all regions that contain one of `touched`, in rising order.
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

using Constraint = BorderEvidence::Constraint;
constexpr float kCertain = 1e6F;  ///< more than all evidence together

/// The constraints of nodes 0, 1, 2 ... that no later one contradicts.
class Constraints {
 public:
  explicit Constraints(std::size_t nodes) : group_(nodes) { std::iota(group_.begin(), group_.end(), 0U); }

  /// Call in order from the newest to the oldest.
  void add(std::uint32_t a, std::uint32_t b, Constraint constraint) {
    const std::uint32_t into = group_[a], from = group_[b];
    if (into == from) return;
    if (constraint == Constraint::cannot_link) {
      apart_.emplace_back(a, b);
    } else if (!areApart(into, from)) {
      std::ranges::replace(group_, from, into);
    }
  }
  /// The representative of a node's must-link group.
  [[nodiscard]] std::uint32_t groupOf(std::uint32_t node) const { return group_[node]; }
  /// Cannot-link pairs.
  [[nodiscard]] const std::vector<std::pair<std::uint32_t, std::uint32_t>>& apart() const { return apart_; }

 private:
  [[nodiscard]] bool areApart(std::uint32_t group, std::uint32_t other) const {
    return std::ranges::any_of(apart_, [&](const auto& pair) {
      return std::minmax(group_[pair.first], group_[pair.second]) == std::minmax(group, other);
    });
  }

  std::vector<std::uint32_t> group_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> apart_;
};

class Divider {
 public:
  Divider(std::vector<FragmentId> members, const EvidenceGraph& graph, std::span<const int> voxels)
      : members_(std::move(members)), graph_(graph), voxels_(voxels) {}

  [[nodiscard]] std::vector<std::vector<FragmentId>> divide(const RegionTable& table,
                                                            const LabelingParams& params) {
    const Constraints constraints = findConstraints(table);
    std::vector<WeightedEdge> edges;
    for (const auto& [a, b] : constraints.apart()) {
      edges.push_back({constraints.groupOf(a), constraints.groupOf(b), -kCertain});
    }
    const std::map<RegionPair, float> lengths_m = lengthsBetween(table);
    forEachBorder([&](std::uint32_t a, std::uint32_t b, const BorderEvidence& border) {
      if (isSmall(members_[a]) || isSmall(members_[b])) return;
      // The hysteresis counts once per pair of regions, however many of their fragments touch.
      const auto between = regionPair(a, b, table);
      const bool are_one = between.first == between.second;
      const float share = are_one ? 1 : border.length_m / std::max(lengths_m.at(between), 1e-6F);
      const float bias = params.joining_bias + (are_one ? params.hysteresis : -params.hysteresis * share);
      edges.push_back({constraints.groupOf(a), constraints.groupOf(b),
                       border.weight(voxelsOf(members_[a]), voxelsOf(members_[b]), bias, are_one)});
    });
    const std::vector<std::uint32_t> part_of_group = contractGreedily(members_.size(), edges);
    std::vector<std::uint32_t> part(members_.size());
    for (std::uint32_t i = 0; i < part.size(); ++i) part[i] = part_of_group[constraints.groupOf(i)];
    attachSmallFragments(part);
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
  /// A fragment with a constraint is never small.
  [[nodiscard]] bool isSmall(FragmentId fragment) const {
    return voxelsOf(fragment) < kSmallFragmentVoxels &&
           std::ranges::all_of(graph_.linksOf(fragment), [this](const EvidenceGraph::Link& link) {
             return graph_.border(link.border).constraint == Constraint::none;
           });
  }

  using RegionPair = std::pair<RegionId, RegionId>;
  [[nodiscard]] RegionPair regionPair(std::uint32_t a, std::uint32_t b, const RegionTable& table) const {
    return std::minmax(table.regionOf(members_[a]), table.regionOf(members_[b]));
  }
  /// Total length of the borders between each pair of regions.
  [[nodiscard]] std::map<RegionPair, float> lengthsBetween(const RegionTable& table) const {
    std::map<RegionPair, float> lengths_m;
    forEachBorder([&](std::uint32_t a, std::uint32_t b, const BorderEvidence& border) {
      if (!isSmall(members_[a]) && !isSmall(members_[b]))
        lengths_m[regionPair(a, b, table)] += border.length_m;
    });
    return lengths_m;
  }

  /// Borders between members, each once: visit(index, index, border).
  void forEachBorder(auto&& visit) const {
    for (std::uint32_t a = 0; a < members_.size(); ++a) {
      for (const EvidenceGraph::Link& link : graph_.linksOf(members_[a])) {
        if (link.other < members_[a]) continue;
        const std::uint32_t b = indexOf(link.other);
        if (b != kOutside) visit(a, b, graph_.border(link.border));
      }
    }
  }

  [[nodiscard]] Constraints findConstraints(const RegionTable& table) const {
    struct UserConstraint {
      std::pair<bool, int> order;
      std::uint32_t a, b;
      Constraint constraint;
    };
    std::vector<UserConstraint> by_order;
    forEachBorder([&](std::uint32_t a, std::uint32_t b, const BorderEvidence& border) {
      if (border.constraint != Constraint::none)
        by_order.push_back({{border.by_person, border.constraint_order}, a, b, border.constraint});
    });
    std::ranges::sort(by_order, std::greater<>(), &UserConstraint::order);
    Constraints constraints(members_.size());
    for (const UserConstraint& entry : by_order) constraints.add(entry.a, entry.b, entry.constraint);
    keepApart(table, constraints);
    return constraints;
  }

  /// Adds cannot-links between each region that a person labelled as an object and all other labelled
  /// regions. A region's largest fragment represents it.
  void keepApart(const RegionTable& table, Constraints& constraints) const {
    std::map<RegionId, std::uint32_t> largest;
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      const RegionId region = table.regionOf(members_[i]);
      if (table.userLabel(region) == UserLabel::nothing) continue;
      const auto [found, is_first] = largest.try_emplace(region, i);
      if (!is_first && voxelsOf(members_[i]) > voxelsOf(members_[found->second])) found->second = i;
    }
    for (auto one = largest.begin(); one != largest.end(); ++one) {
      for (auto other = std::next(one); other != largest.end(); ++other) {
        if (table.userLabel(one->first) == UserLabel::object ||
            table.userLabel(other->first) == UserLabel::object)
          constraints.add(one->second, other->second, Constraint::cannot_link);
      }
    }
  }

  /// Small fragments take the part of a neighbour; those with only small neighbours stay as they are.
  void attachSmallFragments(std::vector<std::uint32_t>& part) const {
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      if (!isSmall(members_[i])) continue;
      float longest_m = 0;
      for (const EvidenceGraph::Link& link : graph_.linksOf(members_[i])) {
        const std::uint32_t other = indexOf(link.other);
        const BorderEvidence& border = graph_.border(link.border);
        if (other == kOutside || isSmall(link.other) || border.length_m <= longest_m) continue;
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

std::vector<std::vector<FragmentId>> partsOfRegion(RegionId region, const EvidenceGraph& graph,
                                                   std::span<const int> voxels, const LabelingParams& params,
                                                   const RegionTable& table) {
  const auto fragments = table.fragmentsOf(region);
  return Divider({fragments.begin(), fragments.end()}, graph, voxels).divide(table, params);
}

void updatePartition(std::span<const FragmentId> touched, const EvidenceGraph& graph,
                     std::span<const int> voxels, const LabelingParams& params, RegionTable& table,
                     RegionEvents& events) {
  std::vector<FragmentId> members = membersOfTouched(touched, table);
  if (members.size() < 2) return;
  table.divide(Divider(std::move(members), graph, voxels).divide(table, params), voxels, events);
}

}  // namespace scantrove
