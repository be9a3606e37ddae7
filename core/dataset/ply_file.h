#pragma once
#include <string>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The properties of a vertex in a PLY file besides `float x y z` and `uchar red green blue`.
struct PlyContent {
  bool normals = true;     ///< float nx ny nz, before the colours
  bool alpha = false;      ///< uchar alpha, 255
  bool label = true;       ///< uint label: the region
  bool estimated = false;  ///< uchar estimated: 1 on estimated surface, else 0
  bool faces = true;       ///< `list uchar int vertex_indices`
  /// Added to all positions; if not zero, x, y and z are double.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

/// The bytes of a binary little-endian PLY file, in the units and the frame of `mesh`; `comment`: one line.
[[nodiscard]] std::string encodePly(const LabeledMesh& mesh, const PlyContent& content,
                                    const std::string& comment);

}  // namespace scantrove
