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
[[nodiscard]] bool isNotEccentric(const RegionExtent& extent, const DiscoveryParams& params);
[[nodiscard]] bool isSizeInRange(const OrientedBox& box, const DiscoveryParams& params);
/// Rejects flat regions, and those that bulge as little as the edge of a board, only if they are larger than
/// a book. From one side a box or a book is a plane, too.
[[nodiscard]] bool isNotFlat(const OrientedBox& box, float bulge, const DiscoveryParams& params);

/// Rejects thin regions that do not bulge, or that are longer than thin objects are: these are strips of
/// larger ones. A thin object bulges even from one side.
[[nodiscard]] bool isNotStrip(const OrientedBox& box, float bulge, const DiscoveryParams& params);

/// Has the size and shape of an object.
[[nodiscard]] inline bool isShapedAsThing(const OrientedBox& box, float bulge,
                                          const DiscoveryParams& params) {
  return isSizeInRange(box, params) && isNotFlat(box, bulge, params) && isNotStrip(box, bulge, params);
}

/// Objects bulge; a concave region is the inside of one, or a corner of the room.
[[nodiscard]] bool isNotHollow(float bulge, const DiscoveryParams& params);

/// Not a part of floor or wall seen between nearer objects.
[[nodiscard]] bool isNotBackground(const OutlineSteps& outline, const DiscoveryParams& params);

}  // namespace scantrove
