#pragma once
#include <functional>
#include <optional>

#include "core/fusion/brick_map.h"
#include "core/meshing/surface_mesh.h"

namespace scantrove {

/// Receives the progress, 0 .. 1; returns false to stop.
using MeshProgress = std::function<bool(double done)>;

/// The surface of a complete map, on the device and in the file, by marching cubes (Lorensen and Cline 1987)
/// over the voxel centres. Covers all cells with eight seen voxels; the result does not depend on the bricks'
/// place in memory, to the last bit. Colours are interpolated; fragments come from the nearest labelled
/// voxels, up to two voxels away. Reads the map page by page without changing it, and needs about 60 MB
/// beside the mesh. None if `may_continue` returns false. Unreadable pages are left out
/// (BrickMap::takeFailure). May throw cl::Error (device lost). The thread of the map's context.
[[nodiscard]] std::optional<SurfaceMesh> extractMesh(BrickMap& map, const MeshProgress& may_continue = {});

}  // namespace scantrove
