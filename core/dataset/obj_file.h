#pragma once
#include <span>
#include <string>

#include "core/dataset/labeled_scan.h"
#include "core/texturing/texture_surface.h"

namespace scantrove {

/// The text of a Wavefront OBJ file of one object called `name` (reduced to one line): `v x y z r g b` with
/// colours from 0 to 1, `vn`, `f a//a b//b c//c`. In the units and the frame of `mesh`; `origin` is added
/// to all positions.
[[nodiscard]] std::string encodeObj(const LabeledMesh& mesh, const std::string& name,
                                    const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// The same with a texture: `v x y z`, `vt` from the lower left corner, `vn`, `f a/b/a ...`, and the material
/// of encodeMtl() in `mtl_file`, a name without blanks. `textures`: of the faces of `mesh`, in their order.
[[nodiscard]] std::string encodeTexturedObj(const LabeledMesh& mesh, std::span<const FaceTexture> textures,
                                            const std::string& name, const std::string& mtl_file,
                                            const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// The text of a material library with a matt material of the texture in `image_file`, a name without blanks.
[[nodiscard]] std::string encodeMtl(const std::string& image_file);

}  // namespace scantrove
