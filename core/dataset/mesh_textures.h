#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/dataset/export_job.h"
#include "core/texturing/surface_texturer.h"

namespace scantrove {

/// The texture of one mesh.
struct MeshTexture {
  std::string png;                    ///< the bytes of the image
  std::vector<FaceTexture> textures;  ///< by face of the mesh
};

/// Textures for the whole surface of a scan and for its parts, from the colour images of the key frames.
class MeshTextures {
 public:
  using FacesByRegion = std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>;

  /// The steps of make(), for the progress.
  [[nodiscard]] static Result<int> stepsOf(ExportJob& job);
  /// Uses the frames of framesToExport(), names those that cannot be read in the summary, and reports steps
  /// from `first_step` of `total_steps`. `faces`: facesByRegion() of `mesh`. Error: no frame can be used;
  /// cancelled.
  [[nodiscard]] static Result<MeshTextures> make(ExportJob& job, const LabeledMesh& mesh,
                                                 const FacesByRegion& faces, int first_step, int total_steps);

  [[nodiscard]] const MeshTexture& scene() const { return scene_; }
  /// The part of the scene's texture for these faces of the mesh.
  [[nodiscard]] std::vector<FaceTexture> inScene(std::span<const std::uint32_t> faces) const;
  /// The texture of a region's mesh, with the image of its own; null: the region has no faces.
  [[nodiscard]] const MeshTexture* of(std::uint32_t region) const;

 private:
  MeshTexture scene_;
  std::unordered_map<std::uint32_t, MeshTexture> parts_;
};

}  // namespace scantrove
