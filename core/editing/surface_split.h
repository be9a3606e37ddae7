#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/editing/surface_graph.h"

namespace scantrove {

/// Cuts a surface in two between some voxels `here` and some `there` (neither empty, disjoint), by a minimum
/// cut of the graph (Boykov and Kolmogorov 2004; OpenCV). Cutting is cheap along folds and colour edges and
/// expensive across plain surface. Each voxel prefers the side with the shorter geodesic path, where folds
/// and colour edges lengthen a path (Price, Morse and Cohen 2010), so that the cut does not just enclose the
/// given voxels, and the side whose main colours it has if the other has not. Each side holds together from
/// its given voxels. Returns 1 for voxels on the side of `there`, 0 for `here`; voxels connected to neither
/// get 0. Any thread.
[[nodiscard]] std::vector<std::uint8_t> splitSurface(const SurfaceGraph& graph,
                                                     std::span<const std::uint32_t> here,
                                                     std::span<const std::uint32_t> there);

/// Cost of cutting an edge: from about 0 across a sharp fold or a colour edge to 1 on plain surface.
[[nodiscard]] float cutCost(const SurfaceGraph::Edge& edge);

/// What a segmentation follows.
enum class SurfaceCues { folds, folds_and_colors };

/// Segments a surface with this k (Felzenszwalb and Huttenlocher 2004, eq. 3.4). Parts with fewer than
/// `min_voxels` join the neighbour across the smallest weight, or without a neighbour the largest part.
/// Returns the part of each voxel, numbered 0, 1,
/// ... in the order of their first voxels. Any thread.
[[nodiscard]] std::vector<std::uint32_t> segmentSurface(const SurfaceGraph& graph, float k, int min_voxels,
                                                        SurfaceCues cues = SurfaceCues::folds);

}  // namespace scantrove
