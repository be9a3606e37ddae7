#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/region_census.h"

namespace scantrove {

/// What the camera sees of a region as if face on: the sum of z^2 / (fx fy) over its pixels that have a
/// surface, m^2. Unlike the area in pixels it stays the same as the camera comes near.
[[nodiscard]] float visibleArea(const RegionExtent& extent, const DiscoveryInput& input);

/// How much of the region's outline is hidden behind something nearer: over the steps from its pixels to
/// other regions' pixels that have a surface, the fraction where that surface is nearer by more than
/// `hiding_step_m` (in proportion to the depth from 1.5 m on). 0 for an object that stands free, 1 for a
/// patch of floor or wall seen through a gap.
[[nodiscard]] float hiddenFraction(const RegionExtent& extent, const DiscoveryInput& input,
                                   const DiscoveryParams& params);

/// The vertices of the region's pixels that have a surface, world, row by row.
[[nodiscard]] std::vector<Eigen::Vector4f> pointsOf(const RegionExtent& extent, const DiscoveryInput& input);

}  // namespace scantrove
