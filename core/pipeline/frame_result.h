#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/discovery/candidate_finder.h"
#include "core/fusion/rendered_view.h"
#include "core/labeling/region_table.h"
#include "core/pipeline/frame_observation.h"
#include "core/segmentation/segment_map.h"
#include "core/tracking/pose_estimate.h"
#include "core/tracking/revisited_key_frame.h"

namespace scantrove {

/// A frame that was unusable at first and integrated into the map later.
struct LateFrame {
  int index = 0;  ///< in the source
  double timestamp_s = 0;
  PoseEstimate pose;
};

/// The result of one frame. Maps are empty when the pose was not usable.
struct FrameResult {
  PoseEstimate pose;
  SegmentMap segments;  ///< S_t
  RenderedView view;    ///< V_t, N_t and S_cloud,t
  FrameObservation observed;
  RegionEvents region_events;                 ///< changes by this frame
  std::vector<Candidate> candidates;          ///< they may overlap
  std::vector<RegionId> regions_in_view;      ///< those with more than a remnant in view
  std::vector<LateFrame> late;                ///< earlier frames that were integrated with this one
  bool is_tracking_key_frame = false;         ///< relocalisation uses this frame from now on
  std::optional<RevisitedKeyFrame> returned;  ///< by a recent frame

  /// The regions of the view without surface that the frame's depth contradicts: it is gone, or is hidden
  /// by a person.
  [[nodiscard]] std::vector<RegionId> shownRegions() const {
    std::vector<RegionId> shown = view.regions;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (observed.contradicted.data[i] != 0) shown[i] = {};
    }
    return shown;
  }
  /// Refers to this and to `shown`; without odds and newly appeared objects.
  [[nodiscard]] DiscoveryInput inputFor(std::span<const RegionId> shown) const {
    return {view, shown, {}, {}, observed.color_lab};
  }
};

}  // namespace scantrove
