#pragma once
#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/region_census.h"

namespace scantrove {

[[nodiscard]] inline bool isSurface(const Eigen::Vector4f& vertex) {
  return vertex.w() != 0 && std::isfinite(vertex.x() + vertex.y() + vertex.z());
}

/// What the camera sees of a region as if face on: the sum of z^2 / (fx fy) over its pixels that have a
/// surface, m^2. Unlike the area in pixels it stays the same as the camera comes near.
[[nodiscard]] float visibleArea(const RegionExtent& extent, const DiscoveryInput& input);

/// The vertices of the regions' pixels that have a surface, world, row by row. `box_px` holds them all.
[[nodiscard]] std::vector<Eigen::Vector4f> pointsOf(const RegionSet& regions, const cv::Rect& box_px,
                                                    const DiscoveryInput& input);

}  // namespace scantrove
