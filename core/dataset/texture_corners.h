#pragma once
#include <span>
#include <vector>

#include "core/dataset/labeled_scan.h"
#include "core/texturing/texture_surface.h"

namespace scantrove {

/// The corners of a textured mesh: vertices at a seam have several places in the texture.
struct TextureCorners {
  struct Corner {
    std::uint32_t vertex = 0;
    Eigen::Vector2f place = Eigen::Vector2f::Zero();  ///< as in FaceTexture
  };
  std::vector<Corner> corners;     ///< each once
  std::vector<FaceCorners> faces;  ///< indices of corners
};

/// `textures`: of the faces of `mesh`, in their order.
[[nodiscard]] TextureCorners textureCornersOf(const LabeledMesh& mesh, std::span<const FaceTexture> textures);

}  // namespace scantrove
