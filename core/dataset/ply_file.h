#pragma once
#include <string>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// What a vertex of a PLY file has besides `float x y z` and `uchar red green blue`.
struct PlyContent {
  bool normals = true;  ///< float nx ny nz, before the colours
  bool alpha = false;   ///< uchar alpha, 255
  bool label = true;    ///< uint label: the region
  bool faces = true;    ///< `list uchar int vertex_indices`
  /// Is added to all places; where it is not zero, x, y and z are double.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

/// The bytes of a binary little-endian PLY file, in the units and the frame of `mesh`; `comment`: one line.
[[nodiscard]] std::string encodePly(const LabeledMesh& mesh, const PlyContent& content,
                                    const std::string& comment);

}  // namespace scantrove
