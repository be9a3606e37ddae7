#pragma once
#include "core/labeling/evidence_graph.h"
#include "core/labeling/fragment_splitter.h"
#include "core/labeling/overlap_graph.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Merges reversibly. Voxels hold fragments, which are never merged. Each frame adds evidence whether
/// touching fragments lie in one segment (EvidenceGraph). Regions are the partition of that graph
/// (updatePartition).
///
/// A segment belongs to the fragment with which it shares most pixels. Its unlabelled pixels take that
/// fragment, and so do its pixels of fragments that it does not cover: this repairs outlines, also within a
/// region. Covered fragments keep their pixels. A segment that overlaps no fragment starts a new one.
class GraphMerger final : public RegionMerger {
 public:
  [[nodiscard]] Outcome merge(const MergeInput& input, RegionTable& table,
                              const LabelingParams& params) override;
  void forget(FragmentId fragment) override;
  [[nodiscard]] std::optional<float> joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                                                 std::span<const int> voxels,
                                                 const LabelingParams& params) const override;
  void mustBeOne(RegionId a, RegionId b, const RegionTable& table) override;
  void mustBeApart(FragmentId a, FragmentId b) override {
    constrain(a, b, LinkConstraint::cannot_link, false);
  }

  void constrain(FragmentId a, FragmentId b, LinkConstraint constraint) override;
  [[nodiscard]] LinkConstraint constraintBetween(FragmentId a, FragmentId b) const override {
    return graph_.constraintBetween(a, b);
  }
  [[nodiscard]] std::vector<FragmentId> neighborsOf(FragmentId fragment) const override;
  [[nodiscard]] std::vector<std::vector<FragmentId>> partsOf(RegionId region, float less,
                                                             const RegionTable& table,
                                                             std::span<const int> voxels,
                                                             const LabelingParams& params) const override;

  [[nodiscard]] EvidenceGraph* evidence() override { return &graph_; }
  [[nodiscard]] const EvidenceGraph& graph() const { return graph_; }

 private:
  using Overlaps = OverlapGraph<FragmentId>;
  void addEvidence(const MergeInput& input, const Overlaps& overlaps);
  void attachParts(const MergeInput& input, const Outcome& outcome, const RegionTable& table);
  void splitFragment(const MergeInput& input, const Overlaps& overlaps, std::span<const FragmentId> owner,
                     RegionTable& table, Outcome& outcome);

  void constrain(FragmentId a, FragmentId b, LinkConstraint constraint, bool by_person);

  EvidenceGraph graph_;
  FragmentSplitter cutter_;
  std::vector<FragmentId> touched_;  // fragments with evidence that changed since the last partition
  std::vector<FragmentId> split_from_, split_off_;  // of this frame, by segment
};

}  // namespace scantrove
