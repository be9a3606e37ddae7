#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/editing/surface_graph.h"

namespace scantrove {

/// Cuts a surface in two between some voxels `here` and some `there` (neither empty, no voxel in both): the
/// minimum cut of the graph (Boykov and Kolmogorov 2004; OpenCV), which is cheap along folds and dear across
/// smooth surface. So that a cut does not just go round what was pointed at, each voxel leans to the side
/// that it is nearer to along the surface, a way over folds being long (Price, Morse and Cohen 2010). Result:
/// 1 for each voxel that goes with `there`, 0 with `here`; what is connected to neither stays here. Any
/// thread.
[[nodiscard]] std::vector<std::uint8_t> splitSurface(const SurfaceGraph& graph,
                                                     std::span<const std::uint32_t> here,
                                                     std::span<const std::uint32_t> there);

/// Takes a surface apart as the segmentation does (Felzenszwalb and Huttenlocher 2004, eq. 3.4) with this k;
/// parts of fewer than `min_voxels` go with the neighbour across the smallest weight. Result: part of each
/// voxel, numbered 0, 1, ... by their first voxels. Any thread.
[[nodiscard]] std::vector<std::uint32_t> segmentSurface(const SurfaceGraph& graph, float k, int min_voxels);

}  // namespace scantrove
