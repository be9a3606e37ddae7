#pragma once
#include "core/discovery/candidate_finder.h"

namespace scantrove {

/// The silhouette of some regions in an image.
struct Silhouette {
  float convexity = 1;  ///< their pixels / those of their convex hull
  float relief_m = 0;   ///< mean depth step where the surface beyond the outline is deeper; 0: nowhere
};

/// `box_px` holds all pixels of the regions.
[[nodiscard]] Silhouette silhouetteOf(const RegionSet& regions, const cv::Rect& box_px,
                                      const DiscoveryInput& input);

}  // namespace scantrove
