#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"
#include "core/texturing/texture_surface.h"

namespace scantrove {

/// One object of a scene.
struct GlbPart {
  std::string name;   ///< any UTF-8
  ExportJson extras;  ///< further data for other programs; null: none
  LabeledMesh mesh;   ///< metres, y up; with faces
  /// Position of the mesh in the scene, metres, y up: GLB has no double-precision vertices.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::vector<FaceTexture> textures = {};  ///< of the faces; empty: vertex colours
};

/// The bytes of a binary glTF 2.0 file: a node with a mesh for each part, positions, normals and vertex
/// colours (linear, as glTF requires, 16 bits), one matt double-sided material. With `png`, the bytes of an
/// image, all parts have textures: the image is embedded, and there are no vertex colours. Error: more than
/// 4 GB.
[[nodiscard]] Result<std::string> encodeGlb(std::span<const GlbPart> parts, const std::string& png = {});

}  // namespace scantrove
