#include <utility>

#include "core/dataset/dataset_formats.h"
#include "core/dataset/glb_file.h"
#include "core/dataset/mesh_parts.h"
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

/// `stem`.ply, .obj and .glb of one surface.
Result<void> writeSurface(ExportJob& job, const std::string& stem, const std::string& title,
                          const LabeledMesh& mesh, const Eigen::Vector3d& origin,
                          std::span<const GlbPart> parts) {
  SCANTROVE_TRY(job.write(stem + ".ply", encodePly(mesh, {.origin = origin}, "metres, label = region id")));
  SCANTROVE_TRY(job.write(stem + ".obj", encodeObj(mesh, title, origin)));
  const auto glb = encodeGlb(parts);
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

/// The files of one object; `mesh` is in the world frame.
Result<void> writeObject(ExportJob& job, const LabeledRegion& region, const LabeledMesh& mesh,
                         const Eigen::Affine3f& y_up, ObjectPlace place) {
  const std::string stem = "objects/" + safeFileName(region.id, displayName(region));
  const bool is_moved = place == ObjectPlace::around_the_origin;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  if (is_moved) middle = boxOf(mesh).center();
  const LabeledMesh placed = transformed(mesh, Eigen::Affine3f(Eigen::Translation3f(-middle)));
  const Eigen::Vector3d scan_origin = job.scan().origin();
  const Eigen::Vector3d origin = is_moved ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : scan_origin;
  const GlbPart part = glbPartOf(&region, placed, y_up, origin);
  SCANTROVE_TRY(writeSurface(job, stem, displayName(region), placed, origin, std::span(&part, 1)));
  return is_moved ? writeOffset(job, stem, region, middle.cast<double>() + scan_origin, y_up)
                  : Result<void>();
}

Result<void> writeMeshes(ExportJob& job, ObjectPlace place) {
  SCANTROVE_TRY(job.step(0, 2, "surface"));
  const auto mesh = job.scan().mesh();
  if (!mesh) return fail(mesh.error());
  SCANTROVE_TRY(checkMesh(*mesh));
  const auto frames = job.scan().keyFrames(false);
  if (!frames) return fail(frames.error());
  const Eigen::Affine3f y_up = turning(upDirection(*frames, *mesh), Eigen::Vector3f::UnitY());
  const Eigen::Vector3d origin = job.scan().origin();
  const auto parts = splitByRegion(*mesh, job.chosen());
  std::vector<GlbPart> scene;
  if (const auto rest = parts.find(0); rest != parts.end())
    scene.push_back(glbPartOf(nullptr, rest->second, y_up, origin));
  int done = 1;
  const auto total = static_cast<int>(job.chosen().size()) + 2;
  for (const LabeledRegion& region : job.chosen()) {
    SCANTROVE_TRY(job.step(done++, total, onOneLine(displayName(region))));
    const auto part = parts.find(region.id);
    if (part == parts.end()) continue;
    scene.push_back(glbPartOf(&region, part->second, y_up, origin));
    SCANTROVE_TRY(writeObject(job, region, part->second, y_up, place));
    job.counts().countObject(classOf(region), job.part().split);
  }
  SCANTROVE_TRY(job.step(done, total, "whole scene"));
  SCANTROVE_TRY(writeSurface(job, "scene", job.scan().name(), *mesh, origin, scene));
  job.summary().points += mesh->vertices.size();
  job.summary().faces += mesh->faces.size();
  return job.write("labels.json", jsonByLines(legendOf(job.allRegions(), job.scan().origin())));
}

}  // namespace

Result<void> exportMesh(ExportJob& job) { return writeMeshes(job, ObjectPlace::in_the_scene); }

Result<void> exportCenteredObjects(ExportJob& job) {
  return writeMeshes(job, ObjectPlace::around_the_origin);
}

}  // namespace scantrove
