#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Surface normals at the centres of a brick's 2 x 2 x 2 cells, cell x + 2 y + 4 z; length = how many points
/// stand behind it, zero where there are hardly any, sign arbitrary.
using CellNormals = std::array<Eigen::Vector3f, 8>;
/// Brightness 0..1 at the same places.
using CellLight = std::array<float, 8>;
/// The 27 bricks around one, index (dx+1) + 3 (dy+1) + 9 (dz+1); null where there is none.
using Neighborhood = std::array<const CellNormals*, 27>;

/// The mean of the normals of the points around each cell's centre; where points have none, from the points
/// themselves (principal components, Gaussian weights).
[[nodiscard]] CellNormals cellNormals(const CloudBrick& brick, float voxel_size_m);

/// Light on the cells of the middle brick. Normals are averaged with those of the cells around that lie on
/// the same surface, so that no brick stands out and edges stay sharp; lit on both sides.
[[nodiscard]] CellLight cellLight(const Neighborhood& bricks);

/// Between the cell centres; `in_brick` in 0..1 along each axis.
[[nodiscard]] float lightAt(const CellLight& light, const Eigen::Vector3f& in_brick);

/// Brightness 0..1 of a surface with this normal (unit, any sign).
[[nodiscard]] float lightOn(const Eigen::Vector3f& normal);

/// For each of a brick's first `count` points the mean of the normals of the voxels around it: what is left
/// of the sensor's noise shows in every highlight.
[[nodiscard]] std::vector<PackedNormal> smoothNormals(const std::vector<CloudBrick::Point>& points,
                                                      std::size_t count, float voxel_size_m);

/// Gives points not seen in colour (along outlines, where colour may be of what is behind) the mean colour of
/// those around them, as far as three voxels.
void spreadColors(std::vector<CloudBrick::Point>& points, float voxel_size_m);

/// Whether nobody would tell `now` from `shown`, the colours of which are spread: the same fragments in the
/// same voxels, but for some on the fringe of the surface, and nearly all of them as high and of a like
/// colour.
[[nodiscard]] bool hasSameAppearance(const std::vector<CloudBrick::Point>& shown,
                                     const std::vector<CloudBrick::Point>& now, float voxel_size_m);

/// Sum of a brick's cell normals, aligned with each other: its main surface.
[[nodiscard]] Eigen::Vector3f mainNormal(const CellNormals& cells);

}  // namespace scantrove
