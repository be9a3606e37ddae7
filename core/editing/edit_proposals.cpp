#include "core/editing/edit_proposals.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace scantrove {
namespace {

/// How many frames must agree for each that contradicts.
constexpr int kAgreement = 3;

bool isClear(int agreeing, int contradicting, const ProposalParams& params) {
  return agreeing >= params.min_frames && agreeing >= kAgreement * contradicting;
}

/// Regions that are to be joined, one group for each object. Votes between two groups are those of their
/// strongest border, for and against, so that a chain of neighbours does not join what masks part.
class JoinGroups {
 public:
  JoinGroups(const MaskEvidence& evidence, const std::set<RegionId>& left_out,
             const UserStatements& statements, const ProposalParams& params)
      : statements_(statements), params_(params) {
    for (const auto& [border, votes] : evidence.borders()) {
      if (left_out.contains(border.first) || left_out.contains(border.second)) continue;
      votes_[border] = votes;
      for (const RegionId region : {border.first, border.second}) groups_[region] = {{region}, std::nullopt};
    }
    while (joinBest()) {
    }
  }

  [[nodiscard]] std::vector<EditProposal> proposals() const {
    std::vector<EditProposal> proposals;
    for (const auto& [first, group] : groups_) {
      if (!group.votes) continue;
      EditProposal proposal{{.kind = OperationKind::join, .regions = group.regions}, *group.votes};
      // The labelled one keeps its identity.
      std::stable_partition(proposal.operation.regions.begin(), proposal.operation.regions.end(),
                            [this](RegionId region) { return statements_.labeled.contains(region); });
      proposals.push_back(std::move(proposal));
    }
    return proposals;
  }

 private:
  using Border = MaskEvidence::Border;
  struct Group {
    std::vector<RegionId> regions;   // rising
    std::optional<MaskVotes> votes;  // of its weakest border; none: one region
  };

  [[nodiscard]] bool mayJoin(const Group& a, const Group& b) const {
    const auto isLabeled = [this](RegionId region) { return statements_.labeled.contains(region); };
    if (std::ranges::count_if(a.regions, isLabeled) + std::ranges::count_if(b.regions, isLabeled) > 1)
      return false;
    return std::ranges::none_of(a.regions, [&](RegionId one) {
      return std::ranges::any_of(
          b.regions, [&](RegionId other) { return statements_.separated.contains(std::minmax(one, other)); });
    });
  }

  /// Joins the two groups with most agreement. False: none may be joined.
  bool joinBest() {
    auto best = votes_.end();
    for (auto candidate = votes_.begin(); candidate != votes_.end(); ++candidate) {
      const auto& [border, votes] = *candidate;
      if (!isClear(votes.together, votes.apart, params_)) continue;
      if (best != votes_.end() && surplusOf(votes) <= surplusOf(best->second)) continue;
      if (mayJoin(groups_.at(border.first), groups_.at(border.second))) best = candidate;
    }
    if (best == votes_.end()) return false;
    const auto [border, votes] = *best;
    votes_.erase(best);
    join(border.first, border.second, votes);
    return true;
  }

  void join(RegionId into, RegionId from, const MaskVotes& votes) {
    const Group gone = std::move(groups_.extract(from).mapped());
    Group& group = groups_.at(into);
    group.regions.insert(group.regions.end(), gone.regions.begin(), gone.regions.end());
    std::ranges::sort(group.regions);
    group.votes = weaker(weaker(group.votes, gone.votes), votes);
    std::map<Border, MaskVotes> moved;
    for (const auto& [border, of_border] : votes_) {
      const auto renamed = [&](RegionId region) { return region == from ? into : region; };
      MaskVotes& strongest = moved[std::minmax({renamed(border.first), renamed(border.second)})];
      strongest.together = std::max(strongest.together, of_border.together);
      strongest.apart = std::max(strongest.apart, of_border.apart);
    }
    votes_ = std::move(moved);
  }

  /// None: no border yet.
  static std::optional<MaskVotes> weaker(const std::optional<MaskVotes>& a,
                                         const std::optional<MaskVotes>& b) {
    if (!a || !b) return a ? a : b;
    return MaskVotes{std::min(a->together, b->together), std::max(a->apart, b->apart)};
  }

  static int surplusOf(const MaskVotes& votes) { return votes.together - votes.apart; }

  const UserStatements& statements_;
  ProposalParams params_;
  std::map<RegionId, Group> groups_;   // by their first region
  std::map<Border, MaskVotes> votes_;  // between groups, by their first regions
};

}  // namespace

void UserStatements::addConstraints(const RegionTable& table, const EvidenceGraph& evidence) {
  const std::vector<RegionId>& regions = table.regions();
  for (std::uint32_t number = 1; number < regions.size(); ++number) {
    const RegionId region = regions[number];
    for (const EvidenceGraph::Link& link : evidence.linksOf(FragmentId{number})) {
      const BorderEvidence& border = evidence.border(link.border);
      const RegionId other = table.regionOf(link.other);
      if (!border.by_person || !region || !other) continue;
      if (border.constraint == LinkConstraint::must_link && region == other) joined.insert(region);
      if (border.constraint == LinkConstraint::cannot_link && region != other)
        separated.insert(std::minmax(region, other));
    }
  }
}

std::vector<EditProposal> proposeEdits(const MaskEvidence& evidence, const MaskPartings& partings,
                                       const UserStatements& statements, const ProposalParams& params) {
  std::vector<EditProposal> proposals;
  std::set<RegionId> cut;
  for (MaskParting& parting : partings.best()) {
    if (!isClear(parting.votes.apart, parting.votes.together, params)) continue;
    cut.insert(parting.region);
    if (statements.labeled.contains(parting.region) || statements.joined.contains(parting.region)) continue;
    proposals.push_back({{.kind = OperationKind::cut,
                          .regions = {parting.region},
                          .here_world = std::move(parting.here_world),
                          .there_world = std::move(parting.there_world)},
                         parting.votes});
  }
  const std::vector<EditProposal> joins = JoinGroups(evidence, cut, statements, params).proposals();
  proposals.insert(proposals.end(), joins.begin(), joins.end());
  std::ranges::stable_sort(proposals, std::greater<>{}, [](const EditProposal& proposal) {
    return std::abs(proposal.votes.together - proposal.votes.apart);
  });
  return proposals;
}

}  // namespace scantrove
