#pragma once
#include <set>
#include <vector>

#include "core/editing/operation.h"
#include "core/labeling/evidence_graph.h"
#include "core/labeling/mask_evidence.h"
#include "core/labeling/mask_partings.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// An operation that masks of another program suggest.
struct EditProposal {
  Operation operation;  ///< join or cut
  MaskVotes votes;      ///< of frames; of a join of several regions, the weakest of its borders
};

/// What a person said about the regions of a scan, which proposals respect.
struct UserStatements {
  std::set<RegionId> labeled;                ///< with a name or a mark
  std::set<RegionId> joined;                 ///< held together by a person's must-link
  std::set<MaskEvidence::Border> separated;  ///< held apart by a person's cannot-link

  /// Adds the constraints of a person.
  void addConstraints(const RegionTable& table, const EvidenceGraph& evidence);
};

struct ProposalParams {
  int min_frames = 3;  ///< that must agree
};

/// Proposals to cut regions and to join regions; each region occurs in one at most. Three times as many
/// frames must agree as contradict. Regions that a person labelled or joined are not cut. A join holds at
/// most one labelled region, which comes first, and none that a person separated. A region to be cut is not
/// joined: masks say that it is several things. The most agreement comes first.
[[nodiscard]] std::vector<EditProposal> proposeEdits(const MaskEvidence& evidence,
                                                     const MaskPartings& partings,
                                                     const UserStatements& statements,
                                                     const ProposalParams& params);

}  // namespace scantrove
