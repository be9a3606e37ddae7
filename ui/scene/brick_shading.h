#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Surface normals at the centres of a brick's 2 x 2 x 2 cells, cell x + 2 y + 4 z. The length is the number
/// of supporting points, 0 for too few; the sign is arbitrary.
using CellNormals = std::array<Eigen::Vector3f, 8>;
/// Brightness 0..1 of these cells.
using CellLight = std::array<float, 8>;
/// A brick and its 26 neighbours, index (dx+1) + 3 (dy+1) + 9 (dz+1); null if there is no brick.
using Neighborhood = std::array<const CellNormals*, 27>;

/// Mean point normal around each cell's centre. If most points have no normal, uses principal components of
/// the points with Gaussian weights.
[[nodiscard]] CellNormals cellNormals(const CloudBrick& brick, float voxel_size_m);

/// Light on the cells of the middle brick, from both sides. Averages normals with neighbouring cells of the
/// same surface, so that bricks are not visible and edges stay sharp.
[[nodiscard]] CellLight cellLight(const Neighborhood& bricks);

/// Light interpolated between cell centres; `in_brick` in 0..1 along each axis.
[[nodiscard]] float lightAt(const CellLight& light, const Eigen::Vector3f& in_brick);

/// Brightness 0..1 of a surface with this normal (unit, any sign).
[[nodiscard]] float lightOn(const Eigen::Vector3f& normal);

/// Mean normal of the voxels around each of a brick's first `count` points. Without it, highlights show the
/// sensor's noise.
[[nodiscard]] std::vector<PackedNormal> smoothNormals(const std::vector<CloudBrick::Point>& points,
                                                      std::size_t count, float voxel_size_m);

/// Gives points without colour the mean colour of their neighbours, up to three voxels away. Points along
/// outlines have none, as it may be that of the background.
void spreadColors(std::vector<CloudBrick::Point>& points, float voxel_size_m);

/// Whether `now` looks like `shown` (after spreadColors()): same fragments in the same voxels except at the
/// fringe of the surface, and nearly all points with similar height and colour.
[[nodiscard]] bool hasSameAppearance(const std::vector<CloudBrick::Point>& shown,
                                     const std::vector<CloudBrick::Point>& now, float voxel_size_m);

/// Sum of a brick's cell normals, aligned with each other.
[[nodiscard]] Eigen::Vector3f mainNormal(const CellNormals& cells);

}  // namespace scantrove
