// What can be read out of ScanPipeline's map: views, counts, the cloud, the mesh.
#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/compute/guarded.h"
#include "core/labeling/region_partition.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {
namespace {

/// Bricks that are read out at a time, and at most a page more: bounds what the whole cloud takes on the
/// device.
constexpr std::size_t kBricksAtATime = 1024;

}  // namespace

Result<RenderedView> ScanPipeline::renderView(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K) {
  return guarded("looking at the map", [&]() -> Result<RenderedView> {
    SurfaceMaps surface;
    return render(K, T_world_camera, surface);
  });
}

Result<SegmentMap> ScanPipeline::segmentAgain() {
  return guarded("segmenting the frame again", [&]() -> Result<SegmentMap> {
    return has_pose_ ? segmenter_->segment(surface_, params_.segmentation) : SegmentMap{};
  });
}

Result<SegmentMap> ScanPipeline::segmentMapFrom(const Eigen::Isometry3d& T_world_camera,
                                                const SegmentationParams& params) {
  return guarded("segmenting a view of the map", [&]() -> Result<SegmentMap> {
    SurfaceMaps surface;
    map_->raycast(T_world_camera, working_K_, surface);
    return segmenter_->segment(surface, params);
  });
}

ScanPipeline::RegionCount ScanPipeline::regionCount() {
  std::unordered_set<RegionId> with_surface;
  const Result<void> read = forEachCloudPoint([&](const LabelPoint& point) {
    if (point.fragment < table_.regions().size()) with_surface.insert(table_.regions()[point.fragment]);
  });
  std::unordered_map<RegionId, std::int64_t> voxels;
  const std::vector<cl_int>& of_fragment = cloud_->voxelsOfFragments();
  for (std::size_t fragment = 1; fragment < std::min(of_fragment.size(), table_.regions().size());
       ++fragment) {
    if (const RegionId region = table_.regions()[fragment]) voxels[region] += of_fragment[fragment];
  }
  RegionCount count;
  for (const auto& [region, of_region] : voxels) {
    if (read && !with_surface.contains(region)) continue;  // without a device the voxels are all there is
    ++(of_region < kSmallFragmentVoxels ? count.small_fragments : count.regions);
  }
  return count;
}

Result<LabelCloud::Extract> ScanPipeline::extractCloud(std::span<const Eigen::Vector3i> bricks) {
  return guarded("reading out the label cloud", [&]() -> Result<LabelCloud::Extract> {
    return cloud_->extract(bricks, map_->bricks(), params_.fusion.truncation_vox);
  });
}

std::vector<Eigen::Vector3i> ScanPipeline::allBricks() const {
  std::vector<Eigen::Vector3i> all;
  for (const int page : bricks().pagesByPosition()) {
    const std::vector<Eigen::Vector3i> in_page = bricks().bricksOfPage(page);
    all.insert(all.end(), in_page.begin(), in_page.end());
  }
  return all;
}

Result<void> ScanPipeline::forEachCloudPoint(const std::function<void(const LabelPoint&)>& visit) {
  std::vector<Eigen::Vector3i> batch;
  const auto visitBatch = [&]() -> Result<void> {
    const Result<LabelCloud::Extract> extract = extractCloud(std::exchange(batch, {}));
    if (!extract) return fail(extract.error());
    for (const LabelPoint& point : extract->points) visit(point);
    return {};
  };
  for (const int page : bricks().pagesByPosition()) {
    const std::vector<Eigen::Vector3i> in_page = bricks().bricksOfPage(page);
    batch.insert(batch.end(), in_page.begin(), in_page.end());
    if (batch.size() >= kBricksAtATime) SCANTROVE_TRY(visitBatch());
  }
  return visitBatch();
}

Result<std::optional<SurfaceMesh>> ScanPipeline::extractMesh(const MeshProgress& may_continue) {
  return guarded("making a mesh of the map", [&]() -> Result<std::optional<SurfaceMesh>> {
    return scantrove::extractMesh(map_->bricks(), may_continue);
  });
}

}  // namespace scantrove
