#pragma once
#include "core/labeling/evidence_graph.h"
#include "core/labeling/fragment_cutter.h"
#include "core/labeling/overlap_graph.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Regions that can part again. Voxels hold fragments, which are never joined; each frame says of fragments
/// that touch whether one segment holds both (EvidenceGraph), and the regions are the parts of the graph that
/// its evidence holds together (updatePartition).
///
/// A segment belongs to the fragment that it shares most pixels with. Its pixels on unlabelled ground take
/// that fragment, so do those of other fragments that it does not cover: outlines heal, also within a region.
/// What it covers of other fragments stays theirs. A segment without any founds a fragment.
class GraphMerger final : public RegionMerger {
 public:
  [[nodiscard]] Outcome merge(const MergeInput& input, RegionTable& table,
                              const LabelingParams& params) override;
  void forget(FragmentId fragment) override;
  [[nodiscard]] std::optional<float> joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                                                 std::span<const int> voxels,
                                                 const LabelingParams& params) const override;
  void mustBeOne(RegionId a, RegionId b, const RegionTable& table) override;

  [[nodiscard]] const EvidenceGraph& graph() const { return graph_; }
  /// Says what two fragments are to each other, whatever is seen; takes effect with the next frame.
  void constrain(FragmentId a, FragmentId b, BorderEvidence::Constraint constraint);

 private:
  using Overlaps = OverlapGraph<FragmentId>;
  void look(const MergeInput& input, const Overlaps& overlaps);
  void carve(const MergeInput& input, const Overlaps& overlaps, std::span<const FragmentId> owner,
             RegionTable& table, Outcome& outcome);

  EvidenceGraph graph_;
  FragmentCutter cutter_;
  std::vector<FragmentId> touched_;               // whose evidence changed since the last partition
  std::vector<FragmentId> carved_from_, carved_;  // of this frame, by segment
};

}  // namespace scantrove
