#pragma once
#include "core/labeling/overlap_graph.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// The literal rule of thesis 3.3.2: the components of the graph of qualifying edges become one region each,
/// at once and for good. A component takes its projected region of largest area, because segment ids last one
/// frame only. A component without projected region becomes a new fragment. Pixels without segment keep their
/// projected label.
class ThesisMerger final : public RegionMerger {
 public:
  [[nodiscard]] Outcome merge(const MergeInput& input, RegionTable& table,
                              const LabelingParams& params) override;
  void forget(FragmentId) override {}
  /// The rule has no odds and ignores constraints.
  [[nodiscard]] std::optional<float> joiningOdds(RegionId, RegionId, const RegionTable&, std::span<const int>,
                                                 const LabelingParams&) const override {
    return std::nullopt;
  }
  void mustBeOne(RegionId, RegionId, const RegionTable&) override {}
  void mustBeApart(FragmentId, FragmentId) override {}
  [[nodiscard]] EvidenceGraph* evidence() override { return nullptr; }
  void constrain(FragmentId, FragmentId, LinkConstraint) override {}
  [[nodiscard]] LinkConstraint constraintBetween(FragmentId, FragmentId) const override {
    return LinkConstraint::none;
  }
  [[nodiscard]] std::vector<FragmentId> neighborsOf(FragmentId) const override { return {}; }
  [[nodiscard]] std::vector<std::vector<FragmentId>> partsOf(RegionId, float, const RegionTable&,
                                                             std::span<const int>,
                                                             const LabelingParams&) const override {
    return {};
  }
};

}  // namespace scantrove
