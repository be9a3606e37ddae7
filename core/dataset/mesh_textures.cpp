#include "core/dataset/mesh_textures.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <utility>

#include "core/dataset/aligned_view.h"
#include "core/dataset/key_frame_images.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

/// More of the surface than this without a view is worth a note.
constexpr double kMuchUnseen = 0.25;

TextureSurface surfaceOf(const LabeledMesh& mesh) {
  TextureSurface surface;
  surface.positions_m.reserve(mesh.vertices.size());
  surface.colors.reserve(mesh.vertices.size());
  for (const SurfacePoint& vertex : mesh.vertices) {
    surface.positions_m.push_back(vertex.position_world_m);
    surface.colors.push_back(vertex.rgb);
  }
  surface.faces = mesh.faces;
  return surface;
}

/// The colour image if it has the size of its camera.
Result<cv::Mat> textureImage(LabeledScan& scan, const KeyFrameInfo& frame) {
  auto color = scan.color(frame.index);
  if (!color) return fail(color.error());
  const bool fits = color->cols == frame.K_color.width && color->rows == frame.K_color.height;
  if (fits && !color->empty()) return color;
  return fail(fmt::format("its colour image is {} x {}, its camera {} x {}.", color->cols, color->rows,
                          frame.K_color.width, frame.K_color.height));
}

Result<std::vector<KeyFrameInfo>> textureFrames(ExportJob& job) {
  auto frames = framesToExport(job, true);
  if (!frames) return fail(frames.error());
  if (!frames->empty() && frames->size() < kNoView) return frames;
  if (!frames->empty())
    return fail("Textures can be made of 65534 frames at most.",
                "Export key frames only (without --all-frames).");
  return fail("The scan " + job.scan().name() + " has no colour image that textures could be made of.",
              job.summary().unfit > 0 ? "Use unfit frames, too (--include-unfit-frames)."
                                      : "Export it without textures.");
}

MeshTexture encodedTexture(PartTexture part) {
  return {part.image.empty() ? std::string() : encodePng(part.image), std::move(part.textures)};
}

}  // namespace

Result<int> MeshTextures::stepsOf(ExportJob& job) {
  const auto frames = textureFrames(job);
  if (!frames) return fail(frames.error());
  return texturingSteps(frames->size());
}

Result<MeshTextures> MeshTextures::make(ExportJob& job, const LabeledMesh& mesh, const FacesByRegion& faces,
                                        int first_step, int total_steps) {
  const auto frames = textureFrames(job);
  if (!frames) return fail(frames.error());
  TexturedScene scene{
      surfaceOf(mesh), {}, [&](std::size_t view) { return textureImage(job.scan(), (*frames)[view]); }};
  for (const KeyFrameInfo& frame : *frames) {
    const auto T_world_color =
        alignedPoseOf(job.scan(), frame, job.scan().depth(frame.index).value_or(cv::Mat()));
    if (!T_world_color) return fail(T_world_color.error());
    scene.views.push_back({frame.K_color, *T_world_color});
  }
  const int size_px = std::clamp(job.options().texture_size_px, kMinTexture_px, kMaxTexture_px);
  std::vector<std::uint32_t> regions;
  for (const LabeledRegion& region : job.chosen()) {
    if (faces.contains(region.id)) regions.push_back(region.id);
  }
  std::vector<TexturePart> parts(1);
  parts.front().faces.resize(mesh.faces.size());
  std::iota(parts.front().faces.begin(), parts.front().faces.end(), 0U);
  for (const std::uint32_t region : regions) parts.push_back({faces.at(region), size_px});
  parts.front().max_size_px = size_px;
  auto made = textureSurface(scene, parts, [&](int done, const std::string& what) {
    return job.step(first_step + done, total_steps, what);
  });
  if (!made) return fail(made.error());
  for (const std::size_t view : made->unused_views) {
    const KeyFrameInfo& frame = (*frames)[view];
    const auto failure = textureImage(job.scan(), frame);
    job.summary().skipped.push_back("Key frame " + std::to_string(frame.index) + " was left out: " +
                                    (failure ? "its image could not be read." : failure.error().what));
  }
  const double unseen = mesh.faces.empty() ? 0
                                           : static_cast<double>(made->faces_without_view) /
                                                 static_cast<double>(mesh.faces.size());
  if (unseen > kMuchUnseen) {
    job.summary().notes.push_back(
        fmt::format("{:.0f} % of the surface is well seen in no key frame and has the colours of the map.",
                    100 * unseen));
  }
  MeshTextures textures;
  textures.scene_ = encodedTexture(std::move(made->parts.front()));
  for (std::size_t i = 0; i < regions.size(); ++i)
    textures.parts_.emplace(regions[i], encodedTexture(std::move(made->parts[i + 1])));
  return textures;
}

std::vector<FaceTexture> MeshTextures::inScene(std::span<const std::uint32_t> faces) const {
  std::vector<FaceTexture> textures;
  textures.reserve(faces.size());
  for (const std::uint32_t face : faces) textures.push_back(scene_.textures[face]);
  return textures;
}

const MeshTexture* MeshTextures::of(std::uint32_t region) const {
  const auto found = parts_.find(region);
  return found == parts_.end() ? nullptr : &found->second;
}

}  // namespace scantrove
