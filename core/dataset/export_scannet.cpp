#include <spdlog/fmt/fmt.h>

#include <map>
#include <set>

#include "core/dataset/dataset_formats.h"
#include "core/dataset/mesh_parts.h"
#include "core/dataset/ply_file.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/up_direction.h"

namespace scantrove {
namespace {

/// File names of ScanNet, which tools search for.
constexpr const char* kSegmentsSuffix = "_vh_clean_2.0.010000.segs.json";

/// A scene name that is valid in file names and without characters at which tools split it.
std::string sceneName(const std::string& scan) {
  const std::string safe = safeFileName(0, scan);
  constexpr std::size_t kNumber = 7;  // "000000_"
  std::string name = safe.size() > kNumber ? safe.substr(kNumber) : "scene";
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name.front() == '.' || name.front() == '-' ? "scene" + name : name;
}

/// Positions are single precision in these files; this is the offset to the recording's world.
std::string originLine(const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return {};
  return fmt::format("origin = {:.6f} {:.6f} {:.6f}\n", origin.x(), origin.y(), origin.z());
}

ExportJson segmentsOf(const LabeledMesh& mesh, const std::string& name) {
  ExportJson indices = ExportJson::array();
  for (const SurfacePoint& vertex : mesh.vertices) indices.push_back(vertex.region);
  return {{"params", ExportJson::object()}, {"sceneId", name}, {"segIndices", std::move(indices)}};
}

/// Objects count from 0, because tools add 1.
ExportJson aggregationOf(ExportJob& job, const LabeledMesh& mesh, const std::string& name) {
  std::set<std::uint32_t> present;
  for (const SurfacePoint& vertex : mesh.vertices) present.insert(vertex.region);
  ExportJson groups = ExportJson::array();
  for (const LabeledRegion& region : job.chosen()) {
    if (!present.contains(region.id)) continue;
    const std::size_t number = groups.size();
    groups.push_back({{"id", number},
                      {"objectId", number},
                      {"segments", ExportJson::array({region.id})},
                      {"label", classOf(region)},
                      {"name", displayName(region)}});
    job.counts().countObject(classOf(region), job.part().split);
  }
  return {{"sceneId", name},
          {"appId", "Scantrove"},
          {"segGroups", std::move(groups)},
          {"segmentsFile", name + kSegmentsSuffix}};
}

}  // namespace

Result<void> exportScannet(ExportJob& job) {
  SCANTROVE_TRY(job.step(0, 2, "surface"));
  auto read = job.scan().mesh();
  if (!read) return fail(read.error());
  SCANTROVE_TRY(checkMesh(*read));
  const auto frames = job.scan().keyFrames(false);
  if (!frames) return fail(frames.error());
  const Eigen::Affine3f z_up = turning(upDirection(*frames, *read), Eigen::Vector3f::UnitZ());
  const LabeledMesh mesh = transformed(std::move(*read), z_up);
  SCANTROVE_TRY(job.step(1, 2, "surface"));
  const std::string name = sceneName(job.scan().name());
  const std::string ply = encodePly(mesh, {.normals = false, .alpha = true, .label = false}, "metres, z up");
  SCANTROVE_TRY(job.write(name + "_vh_clean_2.ply", ply));
  const ExportJson aggregation = aggregationOf(job, mesh, name);
  SCANTROVE_TRY(job.write(name + kSegmentsSuffix, jsonText(segmentsOf(mesh, name), -1)));
  SCANTROVE_TRY(job.write(name + ".aggregation.json", jsonText(aggregation)));
  SCANTROVE_TRY(job.write(name + ".txt", "axisAlignment = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n" +
                                             originLine(z_up.cast<double>() * job.scan().origin()) +
                                             "sceneType = Misc.\n"));
  job.summary().points += mesh.vertices.size();
  job.summary().faces += mesh.faces.size();
  return {};
}

}  // namespace scantrove
