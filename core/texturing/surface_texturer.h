#pragma once
#include <functional>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/texturing/texture_atlas.h"

namespace scantrove {

/// The surface, and who shows it.
struct TexturedScene {
  TextureSurface surface;
  std::vector<TextureView> views;  ///< fewer than kNoView
  /// CV_8UC3, BGR, of the size of the view's K. Error: it cannot be used; others may be.
  std::function<Result<cv::Mat>(std::size_t view)> image;
};

/// Faces that get a texture of their own.
struct TexturePart {
  std::vector<std::uint32_t> faces;
  int max_size_px = 4096;  ///< width and height at most
};

struct PartTexture {
  cv::Mat image;                      ///< CV_8UC3, BGR
  std::vector<FaceTexture> textures;  ///< by face of the part
};

struct SurfaceTextures {
  std::vector<PartTexture> parts;
  std::vector<std::size_t> unused_views;  ///< whose images could not be read
  std::size_t faces_without_view = 0;     ///< of the whole surface: they have the colours of the vertices
};

/// Called before each step, `done` of texturingSteps(). Error: stops.
using TexturingProgress = std::function<Result<void>(int done, const std::string& what)>;
[[nodiscard]] int texturingSteps(std::size_t views);

/// Textures of parts of a surface from the images of its views: each face shows the view that sees it well
/// and like its neighbours (ViewRatings, chooseFaceViews), and seams are levelled over the whole surface
/// (SeamLeveling). The part with most faces has the resolution of the images as far as they fit; the others
/// together have 32 million texels at most. Reads each image twice and holds one at a time. Any thread; the
/// result does not depend on the computer's load. Error: no image can be read (the reason of the first);
/// `progress`.
[[nodiscard]] Result<SurfaceTextures> textureSurface(const TexturedScene& scene,
                                                     std::span<const TexturePart> parts,
                                                     const TexturingProgress& progress = {});

}  // namespace scantrove
