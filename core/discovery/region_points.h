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

/// Means over regions are as good from every so many-th row and column of an image of that width.
[[nodiscard]] constexpr int stepOfMeans(int width) {
  constexpr int kEnough = 320;  // the width of live frames, which are read pixel by pixel
  return width > kEnough ? width / kEnough : 1;
}

/// What the camera sees of a region as if face on: the sum of z^2 / (fx fy) over its pixels that have a
/// surface, m^2. Unlike the area in pixels it stays the same as the camera comes near.
[[nodiscard]] float visibleArea(const RegionExtent& extent, const DiscoveryInput& input);

/// How much the surface of the regions bulges towards who looks at it: the mean of (p - c) . n over the mean
/// of |p - c|, with the surface's points p, their middle c and the normals n. About 0.8 for what is seen of a
/// ball, 0 for a plane, below 0 for a hollow. 0 where nothing is known.
[[nodiscard]] float bulgeOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input);

/// The vertices of the regions' pixels that have a surface, world, row by row. `box_px` holds them all.
/// Labels spill over outlines onto what lies behind, and through gaps: strips of 2 pixels and small pieces
/// that lie behind all else are left out, or a few pixels would double a thing's size.
[[nodiscard]] std::vector<Eigen::Vector4f> pointsOf(const RegionSet& regions, const cv::Rect& box_px,
                                                    const DiscoveryInput& input);

}  // namespace scantrove
