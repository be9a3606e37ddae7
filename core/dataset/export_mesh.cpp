#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/dataset/dataset_formats.h"
#include "core/dataset/glb_file.h"
#include "core/dataset/mesh_parts.h"
#include "core/dataset/mesh_textures.h"
#include "core/dataset/obj_file.h"
#include "core/dataset/ply_file.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/up_direction.h"

namespace scantrove {
namespace {

GlbPart glbPartOf(const LabeledRegion* region, const LabeledMesh& mesh, const Eigen::Affine3f& y_up,
                  const Eigen::Vector3d& origin) {
  GlbPart part{region == nullptr ? "scene" : displayName(*region), nullptr, transformed(mesh, y_up),
               y_up.cast<double>() * origin};
  if (region != nullptr) {
    part.extras = {{"region", region->id},
                   {"object", region->object ? ExportJson(*region->object) : ExportJson(nullptr)},
                   {"class", classOf(*region)}};
  }
  return part;
}

/// `stem`.obj, with its material and its image if there is a texture.
Result<void> writeObj(ExportJob& job, const std::string& stem, const std::string& title,
                      const LabeledMesh& mesh, const Eigen::Vector3d& origin, const MeshTexture* texture) {
  if (texture == nullptr) return job.write(stem + ".obj", encodeObj(mesh, title, origin));
  const std::string name = std::filesystem::path(stem).filename().string();
  SCANTROVE_TRY(job.write(stem + ".png", texture->png));
  SCANTROVE_TRY(job.write(stem + ".mtl", encodeMtl(name + ".png")));
  return job.write(stem + ".obj", encodeTexturedObj(mesh, texture->textures, title, name + ".mtl", origin));
}

/// The files of one surface. `texture`: null without.
Result<void> writeSurface(ExportJob& job, const std::string& stem, const std::string& title,
                          const LabeledMesh& mesh, const Eigen::Vector3d& origin,
                          std::span<const GlbPart> parts, const MeshTexture* texture) {
  SCANTROVE_TRY(job.write(stem + ".ply", encodePly(mesh, {.origin = origin}, "metres, label = region id")));
  SCANTROVE_TRY(writeObj(job, stem, title, mesh, origin, texture));
  const auto glb = encodeGlb(parts, texture == nullptr ? std::string() : texture->png);
  return glb ? job.write(stem + ".glb", *glb) : fail(glb.error());
}

enum class ObjectPlace { in_the_scene, around_the_origin };

ExportJson listOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// The offset of a centred object in the scene.
Result<void> writeOffset(ExportJob& job, const std::string& stem, const LabeledRegion& region,
                         const Eigen::Vector3d& middle, const Eigen::Affine3f& y_up) {
  const ExportJson offset = {{"region", region.id},
                             {"name", displayName(region)},
                             {"offset_m", listOf(middle)},
                             {"glb_offset_m", listOf(y_up.linear().cast<double>() * middle)}};
  return job.write(stem + ".json", jsonText(offset));
}

/// The files of one object; `mesh` is in the world frame. `texture`: null without.
Result<void> writeObject(ExportJob& job, const LabeledRegion& region, const LabeledMesh& mesh,
                         const Eigen::Affine3f& y_up, ObjectPlace place, const MeshTexture* texture) {
  const std::string stem = "objects/" + safeFileName(region.id, displayName(region));
  const bool is_moved = place == ObjectPlace::around_the_origin;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  if (is_moved) middle = boxOf(mesh).center();
  const LabeledMesh placed = transformed(mesh, Eigen::Affine3f(Eigen::Translation3f(-middle)));
  const Eigen::Vector3d scan_origin = job.scan().origin();
  const Eigen::Vector3d origin = is_moved ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : scan_origin;
  GlbPart part = glbPartOf(&region, placed, y_up, origin);
  if (texture != nullptr) part.textures = texture->textures;
  SCANTROVE_TRY(writeSurface(job, stem, displayName(region), placed, origin, std::span(&part, 1), texture));
  return is_moved ? writeOffset(job, stem, region, middle.cast<double>() + scan_origin, y_up)
                  : Result<void>();
}

/// The whole surface with its parts, and their textures if the options ask for them.
struct SceneSurface {
  LabeledMesh mesh;
  MeshTextures::FacesByRegion faces;
  std::unordered_map<std::uint32_t, LabeledMesh> parts;
  std::optional<MeshTextures> textures;
  int steps = 0;  ///< done

  [[nodiscard]] GlbPart glbPart(std::uint32_t id, const LabeledRegion* region, const Eigen::Affine3f& y_up,
                                const Eigen::Vector3d& origin) const {
    GlbPart part = glbPartOf(region, parts.at(id), y_up, origin);
    if (textures) part.textures = textures->inScene(faces.at(id));
    return part;
  }
};

Result<SceneSurface> readSurface(ExportJob& job) {
  SceneSurface surface;
  SCANTROVE_TRY(job.step(0, 2, "surface"));
  SCANTROVE_TRY(moveInto(surface.mesh, job.scan().mesh()));
  SCANTROVE_TRY(checkMesh(surface.mesh));
  surface.faces = facesByRegion(surface.mesh, job.chosen());
  surface.parts = splitByRegion(surface.mesh, job.chosen());
  surface.steps = 1;
  if (job.options().texture_size_px == 0) return surface;
  const auto steps = MeshTextures::stepsOf(job);
  if (!steps) return fail(steps.error());
  const int total = *steps + static_cast<int>(job.chosen().size()) + 2;
  auto textures = MeshTextures::make(job, surface.mesh, surface.faces, surface.steps, total);
  if (!textures) return fail(textures.error());
  surface.textures = std::move(*textures);
  surface.steps += *steps;
  return surface;
}

Result<void> writeMeshes(ExportJob& job, ObjectPlace place) {
  const auto surface = readSurface(job);
  if (!surface) return fail(surface.error());
  const LabeledMesh& mesh = surface->mesh;
  const auto frames = job.scan().keyFrames(false);
  if (!frames) return fail(frames.error());
  const Eigen::Affine3f y_up = turning(upDirection(*frames, mesh), Eigen::Vector3f::UnitY());
  const Eigen::Vector3d origin = job.scan().origin();
  std::vector<GlbPart> scene;
  if (surface->parts.contains(0)) scene.push_back(surface->glbPart(0, nullptr, y_up, origin));
  int done = surface->steps;
  const int total = done + static_cast<int>(job.chosen().size()) + 1;
  for (const LabeledRegion& region : job.chosen()) {
    SCANTROVE_TRY(job.step(done++, total, onOneLine(displayName(region))));
    const auto part = surface->parts.find(region.id);
    if (part == surface->parts.end()) continue;
    scene.push_back(surface->glbPart(region.id, &region, y_up, origin));
    const MeshTexture* texture = surface->textures ? surface->textures->of(region.id) : nullptr;
    SCANTROVE_TRY(writeObject(job, region, part->second, y_up, place, texture));
    job.counts().countObject(classOf(region), job.part().split);
  }
  SCANTROVE_TRY(job.step(done, total, "whole scene"));
  const MeshTexture* texture = surface->textures ? &surface->textures->scene() : nullptr;
  SCANTROVE_TRY(writeSurface(job, "scene", job.scan().name(), mesh, origin, scene, texture));
  job.summary().points += mesh.vertices.size();
  job.summary().faces += mesh.faces.size();
  return job.write("labels.json", jsonByLines(legendOf(job.allRegions(), job.scan().origin())));
}

}  // namespace

Result<void> exportMesh(ExportJob& job) { return writeMeshes(job, ObjectPlace::in_the_scene); }

Result<void> exportCenteredObjects(ExportJob& job) {
  return writeMeshes(job, ObjectPlace::around_the_origin);
}

}  // namespace scantrove
