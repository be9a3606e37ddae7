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

GlbPart glbPartOf(const LabelledRegion* region, const LabelledMesh& mesh, const Eigen::Affine3f& y_up) {
  GlbPart part{region == nullptr ? "scene" : displayName(*region), nullptr, transformed(mesh, y_up)};
  if (region != nullptr) {
    part.extras = {{"region", region->id},
                   {"object", region->object ? ExportJson(*region->object) : ExportJson(nullptr)},
                   {"class", classOf(*region)}};
  }
  return part;
}

/// Faces that a GLB file holds.
std::uint64_t facesIn(const GlbContent& file) {
  std::uint64_t indices = 0;
  if (!file.json.contains("meshes")) return 0;
  for (const ExportJson& mesh : file.json["meshes"])
    indices += file.json["accessors"][mesh["primitives"][0]["indices"].get<std::size_t>()]["count"]
                   .get<std::uint64_t>();
  return indices / 3;
}

/// `stem`.ply, .obj and .glb of one surface.
Result<void> writeSurface(ExportJob& job, const std::string& stem, const std::string& title,
                          const LabelledMesh& mesh, std::span<const GlbPart> parts) {
  const std::string ply = encodePly(mesh, {}, "metres, label = region id");
  SCANTROVE_TRY(job.write(stem + ".ply", ply));
  SCANTROVE_TRY(job.checkSame(stem + ".ply", ply));
  const std::string obj = encodeObj(mesh, title);
  SCANTROVE_TRY(job.write(stem + ".obj", obj));
  SCANTROVE_TRY(job.checkSame(stem + ".obj", obj));
  const auto glb = encodeGlb(parts);
  if (!glb) return fail(glb.error());
  SCANTROVE_TRY(job.write(stem + ".glb", *glb));
  const auto bytes = job.readBack(stem + ".glb");
  if (!bytes) return fail(bytes.error());
  const auto found = decodeGlb(*bytes, stem + ".glb");
  if (!found) return job.readBackFailure(stem + ".glb", found.error().what);
  if (facesIn(*found) != mesh.faces.size()) return job.readBackFailure(stem + ".glb", "faces are missing");
  return {};
}

}  // namespace

Result<void> exportMesh(ExportJob& job) {
  SCANTROVE_TRY(job.step(0, 2, "surface"));
  const auto mesh = job.scan().mesh();
  if (!mesh) return fail(mesh.error());
  SCANTROVE_TRY(checkMesh(*mesh));
  const auto frames = job.scan().keyFrames(false);
  if (!frames) return fail(frames.error());
  const Eigen::Affine3f y_up = turning(upDirection(*frames, *mesh), Eigen::Vector3f::UnitY());
  const auto parts = splitByRegion(*mesh, job.chosen());
  std::vector<GlbPart> scene;
  if (const auto rest = parts.find(0); rest != parts.end())
    scene.push_back(glbPartOf(nullptr, rest->second, y_up));
  int done = 1;
  const auto total = static_cast<int>(job.chosen().size()) + 2;
  for (const LabelledRegion& region : job.chosen()) {
    SCANTROVE_TRY(job.step(done++, total, onOneLine(displayName(region))));
    const auto part = parts.find(region.id);
    if (part == parts.end()) continue;
    scene.push_back(glbPartOf(&region, part->second, y_up));
    SCANTROVE_TRY(writeSurface(job, "objects/" + safeFileName(region.id, displayName(region)),
                               displayName(region), part->second, std::span(&scene.back(), 1)));
    ++job.summary().annotations;
  }
  SCANTROVE_TRY(job.step(done, total, "whole scene"));
  SCANTROVE_TRY(writeSurface(job, "scene", job.scan().name(), *mesh, scene));
  job.summary().points = mesh->vertices.size();
  job.summary().faces = mesh->faces.size();
  const ExportJson legend = legendOf(job.allRegions());
  SCANTROVE_TRY(job.write("labels.json", jsonByLines(legend)));
  return job.checkJson("labels.json", legend);
}

}  // namespace scantrove
