#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/fusion/rendered_view.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/link_constraint.h"
#include "core/labeling/region_table.h"
#include "core/segmentation/segment_map.h"

namespace scantrove {

class EvidenceGraph;

/// Input of merging for one frame. All images have the view's size.
struct MergeInput {
  const SegmentMap& segments;                  ///< S_t
  const RenderedView& view;                    ///< V_t, N_t, and S_prj,t as its fragments
  std::span<const Eigen::Vector3f> color_lab;  ///< CIE L*a*b*; empty without colour
  std::span<const int> voxels;                 ///< voxels of each fragment, by fragment number
  /// The appeared object at each pixel (AppearedObjects), 0 where none. Empty: no object appeared.
  std::span<const std::uint8_t> appeared = {};
};

/// Merges the segments of one frame with the regions of the label cloud (thesis 3.3). One thread.
class RegionMerger {
 public:
  struct Outcome {
    std::vector<FragmentId> fragments;   ///< S_cloud,t: the fragment for the voxels seen in each pixel
    std::vector<RegionId> regions;       ///< the regions of `fragments` after this frame
    RegionEvents events;                 ///< changes in this frame
    std::vector<FragmentId> split_off;   ///< split from others in this frame; voxels change to them at once
    std::vector<FragmentId> split_from;  ///< the former fragment of each in `split_off`
  };

  virtual ~RegionMerger() = default;
  [[nodiscard]] virtual Outcome merge(const MergeInput& input, RegionTable& table,
                                      const LabelingParams& params) = 0;
  /// No voxel holds the fragment any more; its number may be reused.
  virtual void forget(FragmentId fragment) = 0;

  /// Log-odds that two regions are one object, from all borders between them. None without evidence, or if a
  /// constraint separates them.
  [[nodiscard]] virtual std::optional<float> joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                                                         std::span<const int> voxels,
                                                         const LabelingParams& params) const = 0;
  /// Joins the regions regardless of evidence, from the next frame on.
  virtual void mustBeOne(RegionId a, RegionId b, const RegionTable& table) = 0;
  /// Separates the fragments regardless of evidence, from the next frame on. A person's constraint overrides
  /// this.
  virtual void mustBeApart(FragmentId a, FragmentId b) = 0;

  /// The evidence of borders, for storing; null if the rule has none.
  [[nodiscard]] virtual EvidenceGraph* evidence() = 0;

  /// Sets a person's constraint, which overrides evidence from the next frame on.
  virtual void constrain(FragmentId a, FragmentId b, LinkConstraint constraint) = 0;
  [[nodiscard]] virtual LinkConstraint constraintBetween(FragmentId a, FragmentId b) const = 0;
  /// Fragments observed to touch this one, in rising order.
  [[nodiscard]] virtual std::vector<FragmentId> neighborsOf(FragmentId fragment) const = 0;
  /// The parts of a region if the log-odds of every border were lower by `less`.
  [[nodiscard]] virtual std::vector<std::vector<FragmentId>> partsOf(RegionId region, float less,
                                                                     const RegionTable& table,
                                                                     std::span<const int> voxels,
                                                                     const LabelingParams& params) const = 0;
};

[[nodiscard]] std::unique_ptr<RegionMerger> makeRegionMerger(LabelingParams::Rule rule);

}  // namespace scantrove
