#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/labeling/label_table.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/overlap_graph.h"
#include "core/labeling/region_map.h"
#include "core/segmentation/segment_map.h"

namespace scantrove {

/// Merges the segments of one frame with the regions projected from the label cloud (thesis 3.3.2). One
/// thread.
///
/// Rule `thesis`: the components of the graph of qualifying edges become one region each, at once. A
/// component is named by its projected region of largest area (segment ids have no life beyond their frame);
/// one without any gets a new label.
///
/// Rule `evidence` (after Tateno et al. 2015): frames vote on each pair of regions. A segment that qualifies
/// with both speaks for joining them; where they touch in the image and the segments keep them apart, the
/// frame speaks against. They are joined when the votes for lead by `evidence_frames`; votes against count up
/// to twice that, so that a long time apart outweighs a short leak, but not for ever. Until then such a
/// segment overwrites neither: its pixels keep their projected region, and only the rest take the region of
/// largest overlap.
class RegionMerger {
 public:
  struct Outcome {
    RegionMap map;                                      ///< S_cloud,t
    std::vector<std::pair<RegionId, RegionId>> joined;  ///< (into, from) of this frame
  };

  /// `projected`: raw labels, pixel by pixel like `segments.ids`. Pixels without segment keep their projected
  /// label.
  [[nodiscard]] Outcome merge(const SegmentMap& segments, std::span<const std::uint32_t> projected,
                              LabelTable& table, const LabelingParams& params);

 private:
  using RegionPair = std::pair<std::uint32_t, std::uint32_t>;  // smaller id first

  void joinComponents(const OverlapGraph& graph, const LabelingParams& params, LabelTable& table,
                      Outcome& outcome) const;
  void joinByEvidence(const OverlapGraph& graph, const std::vector<RegionPair>& touching,
                      const LabelingParams& params, LabelTable& table, Outcome& outcome);

  /// What was known of a region that was joined is now known of the region that it became part of.
  void renameJoined(const LabelTable& table);

  std::map<RegionPair, int> evidence_;  // votes for less votes against
};

}  // namespace scantrove
