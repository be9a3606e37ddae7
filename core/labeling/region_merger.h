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

/// What merging looks at in one frame. All images have the pixels of the view.
struct MergeInput {
  const SegmentMap& segments;                  ///< S_t
  const RenderedView& view;                    ///< V_t, N_t, and S_prj,t as its fragments
  std::span<const Eigen::Vector3f> color_lab;  ///< CIE L*a*b*; empty where there is no colour
  std::span<const int> voxels;                 ///< that hold each fragment, by fragment number
  /// Which thing came into the scene with the surface of a pixel, as Arrivals has it, 0: it was there before.
  /// Empty: nothing came.
  std::span<const std::uint8_t> appeared = {};
};

/// Merges the segments of one frame with the regions of the label cloud (thesis 3.3). One thread.
class RegionMerger {
 public:
  struct Outcome {
    std::vector<FragmentId> fragments;   ///< S_cloud,t: what the voxels seen in each pixel are to hold
    std::vector<RegionId> regions;       ///< the same resolved as known at this frame
    RegionEvents events;                 ///< what this frame changed
    std::vector<FragmentId> split_off;   ///< cut out of others in this frame: take their voxels at once
    std::vector<FragmentId> split_from;  ///< of which each of these was a part until now
  };

  virtual ~RegionMerger() = default;
  [[nodiscard]] virtual Outcome merge(const MergeInput& input, RegionTable& table,
                                      const LabelingParams& params) = 0;
  /// No voxel holds the fragment any more; its number may come again for another.
  virtual void forget(FragmentId fragment) = 0;

  /// Log-odds that two regions are one thing, by all that is known of the borders between them; none where
  /// nothing is, or what was said keeps them apart.
  [[nodiscard]] virtual std::optional<float> joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                                                         std::span<const int> voxels,
                                                         const LabelingParams& params) const = 0;
  /// The regions are one thing whatever is seen; takes effect with the next frame.
  virtual void mustBeOne(RegionId a, RegionId b, const RegionTable& table) = 0;
  /// The fragments are two things whatever is seen, unless a person says otherwise; takes effect with the
  /// next frame.
  virtual void mustBeApart(FragmentId a, FragmentId b) = 0;

  /// What is known of borders, for one who keeps it; null: the rule keeps nothing.
  [[nodiscard]] virtual EvidenceGraph* evidence() = 0;

  /// A person says what two fragments are to each other, whatever is seen; takes effect with the next frame.
  virtual void constrain(FragmentId a, FragmentId b, LinkConstraint constraint) = 0;
  /// What was said of two fragments.
  [[nodiscard]] virtual LinkConstraint constraintBetween(FragmentId a, FragmentId b) const = 0;
  /// Fragments that were seen to touch this one, rising.
  [[nodiscard]] virtual std::vector<FragmentId> neighborsOf(FragmentId fragment) const = 0;
  /// What a region would part into if every border spoke `less` (log-odds) less for joining.
  [[nodiscard]] virtual std::vector<std::vector<FragmentId>> partsOf(RegionId region, float less,
                                                                     const RegionTable& table,
                                                                     std::span<const int> voxels,
                                                                     const LabelingParams& params) const = 0;
};

[[nodiscard]] std::unique_ptr<RegionMerger> makeRegionMerger(LabelingParams::Rule rule);

}  // namespace scantrove
