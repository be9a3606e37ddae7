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

/// The step between rows and columns that suffices for means over regions in an image of this width.
[[nodiscard]] constexpr int stepOfMeans(int width) {
  constexpr int kEnough = 320;  // the width of live frames, which are read pixel by pixel
  return width > kEnough ? width / kEnough : 1;
}

/// The visible area of a region: the sum of z^2 / (fx fy) over its pixels with a surface, m^2. Unlike the
/// pixel count it does not depend on the camera's distance.
[[nodiscard]] float visibleArea(const RegionExtent& extent, const DiscoveryInput& input);

/// How much the regions' surface bulges towards the camera: the mean of (p - c) . n over the mean of |p - c|,
/// with points p, their centre c and normals n. About 0.8 for the visible side of a ball, 0 for a plane,
/// below 0 for a concave surface. 0 if unknown.
[[nodiscard]] float bulgeOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input);

/// The vertices of the regions' pixels with a surface, world, row by row. `box_px` holds them all. Labels
/// spill over outlines and through gaps onto the background, where a few pixels could double an object's
/// size. So strips of 2 pixels and small components behind all others are left out.
[[nodiscard]] std::vector<Eigen::Vector4f> pointsOf(const RegionSet& regions, const cv::Rect& box_px,
                                                    const DiscoveryInput& input);

}  // namespace scantrove
