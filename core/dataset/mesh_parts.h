#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The faces of each region, ascending, by its id; 0: the faces of no region in `regions`. A face belongs to
/// the region of two of its corners, else of the first.
[[nodiscard]] std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> facesByRegion(
    const LabeledMesh& mesh, std::span<const LabeledRegion> regions);

/// The part of the surface of each region with the faces of facesByRegion(), in their order. Unused vertices
/// are left out.
[[nodiscard]] std::unordered_map<std::uint32_t, LabeledMesh> splitByRegion(
    const LabeledMesh& mesh, std::span<const LabeledRegion> regions);

/// Transforms positions by T, and rotates normals.
[[nodiscard]] LabeledMesh transformed(LabeledMesh mesh, const Eigen::Affine3f& T);

/// The box around the vertices.
[[nodiscard]] Eigen::AlignedBox3f boxOf(const LabeledMesh& mesh);

/// The largest distance between two vertices; exact. 0 without vertices.
[[nodiscard]] float diameterOf(const LabeledMesh& mesh);

/// Error: a face refers to a missing vertex, or a number is not finite.
[[nodiscard]] Result<void> checkMesh(const LabeledMesh& mesh);

}  // namespace scantrove
