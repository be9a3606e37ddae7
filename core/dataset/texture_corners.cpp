#include "core/dataset/texture_corners.h"

#include <limits>

namespace scantrove {

TextureCorners textureCornersOf(const LabeledMesh& mesh, std::span<const FaceTexture> textures) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  TextureCorners result;
  result.faces.reserve(textures.size());
  std::vector<std::uint32_t> first(mesh.vertices.size(), kNone);  // corner of each vertex
  std::vector<std::uint32_t> next;                                // the next one of the same vertex
  for (std::size_t face = 0; face < textures.size(); ++face) {
    FaceCorners own{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh.faces[face][i];
      std::uint32_t corner = first[vertex];
      while (corner != kNone && result.corners[corner].place != textures[face][i]) corner = next[corner];
      if (corner == kNone) {
        corner = static_cast<std::uint32_t>(result.corners.size());
        result.corners.push_back({vertex, textures[face][i]});
        next.push_back(first[vertex]);
        first[vertex] = corner;
      }
      own[i] = corner;
    }
    result.faces.push_back(own);
  }
  return result;
}

}  // namespace scantrove
