#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The part of the surface that belongs to each region, by its id; 0: all faces of none of `regions`. A face
/// belongs to the region of two of its corners, else of the first. Vertices of no face are left out.
[[nodiscard]] std::unordered_map<std::uint32_t, LabeledMesh> splitByRegion(
    const LabeledMesh& mesh, std::span<const LabeledRegion> regions);

/// Moves positions by T, and turns normals.
[[nodiscard]] LabeledMesh transformed(LabeledMesh mesh, const Eigen::Affine3f& T);

/// The box around the vertices.
[[nodiscard]] Eigen::AlignedBox3f boxOf(const LabeledMesh& mesh);

/// The largest distance between two vertices; exact. 0 without vertices.
[[nodiscard]] float diameterOf(const LabeledMesh& mesh);

/// Error: a face names a vertex that is not there, or a number is not finite.
[[nodiscard]] Result<void> checkMesh(const LabeledMesh& mesh);

}  // namespace scantrove
