#pragma once
#include <opencv2/core/types.hpp>

#include "core/capture/intrinsics.h"
#include "core/discovery/discovery_params.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_outlines.h"

namespace scantrove {

// The rules of thesis 5.1; each is asked by itself, cheapest first.

/// The image without the strips at its edges in which nothing is labelled: what reaches this frame's border
/// is cut off by it. A strip counts up to `max_strip_fraction` of the image's width or height; wider
/// emptiness is emptiness of the scene.
[[nodiscard]] cv::Rect visibleFrame(const RegionCensus& census, int width, int height,
                                    const DiscoveryParams& params);

/// Does not reach the edge of what is visible; floors, walls and tables do.
[[nodiscard]] bool isOffBorder(const RegionExtent& extent, const cv::Rect& visible_px,
                               const DiscoveryParams& params);
[[nodiscard]] bool hasEnoughPoints(const RegionExtent& extent, const Intrinsics& K,
                                   const DiscoveryParams& params);
[[nodiscard]] bool isCentral(const RegionExtent& extent, const Intrinsics& K, const DiscoveryParams& params);
[[nodiscard]] bool isNotEccentric(const RegionExtent& extent, const DiscoveryParams& params);
[[nodiscard]] bool isSizeInRange(const OrientedBox& box, const DiscoveryParams& params);
/// From one side a box or a book is a plane too: flat, or what bulges as little as the edge of a board does,
/// is refused only where it is larger than a book.
[[nodiscard]] bool isNotFlat(const OrientedBox& box, float bulge, const DiscoveryParams& params);

/// From one side a thin thing bulges too; what is thin and does not is a strip of something larger, and
/// so is what is thin and longer than such things are.
[[nodiscard]] bool isNotStrip(const OrientedBox& box, float bulge, const DiscoveryParams& params);

/// Its size and shape are those of a thing.
[[nodiscard]] inline bool isShapedAsThing(const OrientedBox& box, float bulge,
                                          const DiscoveryParams& params) {
  return isSizeInRange(box, params) && isNotFlat(box, bulge, params) && isNotStrip(box, bulge, params);
}

/// Things bulge; what is hollow is the inside of one, or a corner of the room.
[[nodiscard]] bool isNotHollow(float bulge, const DiscoveryParams& params);

/// Not a piece of floor or wall between nearer things.
[[nodiscard]] bool isNotBackground(const OutlineSteps& outline, const DiscoveryParams& params);

}  // namespace scantrove
