#pragma once
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/discovery/discovery_params.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_census.h"

namespace scantrove {

/// The rules of thesis 5.1, cheapest first; the order in which the finder asks them.
enum class DiscoveryRule {
  off_border,  ///< does not reach the edge of what is visible (floors, walls and tables do)
  enough_points,
  central,
  not_eccentric,
  persistent,  ///< seen several times in a row with one size
  size_in_range,
  not_flat,
  not_background,  ///< not a piece of floor or wall between nearer things
};

/// The image without the strips at its edges in which nothing is labelled (a Kinect's depth image has such
/// strips): what reaches this frame's border is cut off by it. A strip counts up to a 25th of the image's
/// width or height; wider emptiness is emptiness of the scene.
[[nodiscard]] cv::Rect visibleFrame(const RegionCensus& census, int width, int height);

[[nodiscard]] bool isOffBorder(const RegionExtent& extent, const cv::Rect& visible_px,
                               const DiscoveryParams& params);
[[nodiscard]] bool hasEnoughPoints(const RegionExtent& extent, const Intrinsics& K,
                                   const DiscoveryParams& params);
[[nodiscard]] bool isCentral(const RegionExtent& extent, const Intrinsics& K, const DiscoveryParams& params);
[[nodiscard]] bool isNotEccentric(const RegionExtent& extent, const DiscoveryParams& params);
[[nodiscard]] bool isSizeInRange(const OrientedBox& box, const DiscoveryParams& params);
/// From one side a box or a book is a plane too: flat is refused only where it is larger than a book.
[[nodiscard]] bool isNotFlat(const OrientedBox& box, const DiscoveryParams& params);

[[nodiscard]] bool isNotBackground(float hidden_fraction, const DiscoveryParams& params);

/// What the rules look at besides the image.
struct RegionShape {
  OrientedBox box;
  float hidden_fraction = 0;
  bool is_persistent = false;
};

/// All rules that a region breaks, in the order above; the finder stops at the first.
[[nodiscard]] std::vector<DiscoveryRule> brokenRules(const RegionExtent& extent, const RegionShape& shape,
                                                     const cv::Rect& visible_px, const Intrinsics& K,
                                                     const DiscoveryParams& params);

}  // namespace scantrove
