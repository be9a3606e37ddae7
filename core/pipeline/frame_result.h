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

/// A frame that could not be used when it came, and went into the map later.
struct LateFrame {
  int index = 0;  ///< of the source
  double timestamp_s = 0;
  PoseEstimate pose;
};

/// What one frame gave. Maps are empty when the pose was not usable.
struct FrameResult {
  PoseEstimate pose;
  SegmentMap segments;  ///< S_t
  RenderedView view;    ///< V_t, N_t and S_cloud,t
  FrameObservation observed;
  RegionEvents region_events;                 ///< what this frame changed
  std::vector<Candidate> candidates;          ///< they may overlap
  std::vector<RegionId> regions_in_view;      ///< of which the frame shows more than a rest
  std::vector<LateFrame> late;                ///< earlier ones that were understood with this one
  bool is_tracking_key_frame = false;         ///< the camera finds its way by this frame from now on
  std::optional<RevisitedKeyFrame> returned;  ///< that the frame before, or one before it, came back to

  /// The regions of the view without what the frame's depth contradicts: that is not there, or stands behind
  /// somebody.
  [[nodiscard]] std::vector<RegionId> shownRegions() const {
    std::vector<RegionId> shown = view.regions;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (observed.contradicted.data[i] != 0) shown[i] = {};
    }
    return shown;
  }
  /// Refers to this and to `shown`; without odds and without what newly appeared.
  [[nodiscard]] DiscoveryInput inputFor(std::span<const RegionId> shown) const {
    return {view, shown, {}, {}, observed.color_lab};
  }
};

}  // namespace scantrove
