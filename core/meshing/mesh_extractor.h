#pragma once
#include <functional>
#include <optional>

#include "core/fusion/brick_map.h"
#include "core/meshing/surface_mesh.h"

namespace scantrove {

/// Hears how much is done, 0 .. 1; false: stop.
using MeshProgress = std::function<bool(double done)>;

/// The surface of all of a map, wherever its bricks are, by marching cubes (Lorensen and Cline 1987) over the
/// centres of its voxels: of all cells whose eight voxels were seen, the same to the last bit however bricks
/// lie in memory. Colours are between those of the voxels on both sides; fragments are those of the nearest
/// labelled voxels, up to two voxels away. The map is read page by page and not changed; beside the mesh this
/// takes about 60 MB.
/// Nothing: `may_continue` said false. Pages that cannot be read are left out (BrickMap::takeFailure). May
/// throw cl::Error (device lost). The thread of the map's context.
[[nodiscard]] std::optional<SurfaceMesh> extractMesh(BrickMap& map, const MeshProgress& may_continue = {});

}  // namespace scantrove
