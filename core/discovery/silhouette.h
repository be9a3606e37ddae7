#pragma once
#include "core/discovery/candidate_finder.h"

namespace scantrove {

/// How some regions stand out in an image.
struct Silhouette {
  float convexity = 1;  ///< their pixels by those of their convex hull
  float relief_m = 0;   ///< mean of how much deeper it is beyond their outline, where it is; 0: nowhere
};

/// `box_px` holds all pixels of the regions.
[[nodiscard]] Silhouette silhouetteOf(const RegionSet& regions, const cv::Rect& box_px,
                                      const DiscoveryInput& input);

}  // namespace scantrove
