#pragma once
#include <opencv2/core/types.hpp>

#include "core/capture/intrinsics.h"
#include "core/discovery/discovery_params.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_outlines.h"

namespace scantrove {

// The rules of thesis 5.1, cheapest first.

/// The image without unlabelled strips at its edges; regions that reach the result's border are cut off. A
/// strip is at most `max_strip_fraction` of the image's width or height; a wider one is empty space.
[[nodiscard]] cv::Rect visibleFrame(const RegionCensus& census, int width, int height,
                                    const DiscoveryParams& params);

/// Does not reach the border of the visible frame, as floors, walls and tables do.
[[nodiscard]] bool isOffBorder(const RegionExtent& extent, const cv::Rect& visible_px,
                               const DiscoveryParams& params);
[[nodiscard]] bool hasEnoughPoints(const RegionExtent& extent, const Intrinsics& K,
                                   const DiscoveryParams& params);
[[nodiscard]] bool isCentral(const RegionExtent& extent, const Intrinsics& K, const DiscoveryParams& params);
[[nodiscard]] bool isEccentric(const RegionExtent& extent, const DiscoveryParams& params);
[[nodiscard]] bool isSizeInRange(const OrientedBox& box, const DiscoveryParams& params);
/// Larger than a book, and flat or bulging as little as the edge of a board. From one side a box or a book is
/// a plane, too.
[[nodiscard]] bool isFlat(const OrientedBox& box, float bulge, const DiscoveryParams& params);

/// A strip of a larger region: thin, and without a bulge or longer than thin objects are. A thin object
/// bulges even from one side.
[[nodiscard]] bool isStrip(const OrientedBox& box, float bulge, const DiscoveryParams& params);

/// Has the size and shape of an object.
[[nodiscard]] inline bool isShapedAsObject(const OrientedBox& box, float bulge,
                                           const DiscoveryParams& params) {
  return isSizeInRange(box, params) && !isFlat(box, bulge, params) && !isStrip(box, bulge, params);
}

/// The inside of an object, or a corner of the room. Objects bulge.
[[nodiscard]] bool isConcave(float bulge, const DiscoveryParams& params);

/// A part of floor or wall seen between nearer objects.
[[nodiscard]] bool isBackground(const OutlineSteps& outline, const DiscoveryParams& params);

}  // namespace scantrove
