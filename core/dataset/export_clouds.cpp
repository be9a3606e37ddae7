#include "core/dataset/dataset_formats.h"
#include "core/dataset/ply_file.h"
#include "core/dataset/region_choice.h"
#include "core/exchange/cloud_writer.h"

namespace scantrove {
namespace {

Result<LabeledMesh> readCloud(ExportJob& job) {
  SCANTROVE_TRY(job.step(0, 2, "cloud"));
  LabeledMesh cloud;
  SCANTROVE_TRY(job.scan().forEachPoint([&](const SurfacePoint& point) {
    if (point.position_world_m.allFinite()) cloud.vertices.push_back(point);
  }));
  job.summary().points += cloud.vertices.size();
  SCANTROVE_TRY(job.step(1, 2, "cloud"));
  return cloud;
}

Result<void> writeLegend(ExportJob& job) {
  const ExportJson legend = legendOf(job.allRegions(), job.scan().origin());
  return job.write("labels.json", jsonByLines(legend));
}

/// The first pose of the recording; the world's origin without poses.
Result<Eigen::Isometry3d> firstCamera(ExportJob& job) {
  const auto trajectory = job.scan().trajectory();
  if (!trajectory) return fail(trajectory.error());
  if (trajectory->empty()) return Eigen::Isometry3d::Identity();
  Eigen::Isometry3d first = trajectory->front().T_world_camera;
  first.translation() += job.scan().origin();
  return first;
}

}  // namespace

Result<void> exportPlyCloud(ExportJob& job) {
  const auto cloud = readCloud(job);
  if (!cloud) return fail(cloud.error());
  const std::string bytes =
      encodePly(*cloud, {.estimated = true, .faces = false, .origin = job.scan().origin()}, kCloudComment);
  SCANTROVE_TRY(job.write("cloud.ply", bytes));
  return writeLegend(job);
}

Result<void> exportPcdCloud(ExportJob& job) {
  const auto cloud = readCloud(job);
  if (!cloud) return fail(cloud.error());
  const auto viewpoint = firstCamera(job);
  if (!viewpoint) return fail(viewpoint.error());
  std::vector<LabeledPoint> points;
  points.reserve(cloud->vertices.size());
  for (const SurfacePoint& p : cloud->vertices) {
    points.push_back({p.position_world_m.x(), p.position_world_m.y(), p.position_world_m.z(), p.rgb[0],
                      p.rgb[1], p.rgb[2], p.region, static_cast<std::uint8_t>(p.is_estimated)});
  }
  const std::string bytes = encodePcd(points, *viewpoint, job.scan().origin());
  SCANTROVE_TRY(job.write("cloud.pcd", bytes));
  return writeLegend(job);
}

}  // namespace scantrove
