#pragma once
#include <string>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The text of a Wavefront OBJ file of one object called `name` (reduced to one line): `v x y z r g b` with
/// colours from 0 to 1, `vn`, `f a//a b//b c//c`. In the units and the frame of `mesh`; `origin` is added
/// to all positions.
[[nodiscard]] std::string encodeObj(const LabeledMesh& mesh, const std::string& name,
                                    const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace scantrove
