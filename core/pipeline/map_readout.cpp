#include "core/pipeline/map_readout.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/compute/guarded.h"
#include "core/labeling/region_partition.h"

namespace scantrove {
namespace {

/// Bricks read out at a time, plus at most a page: bounds the device memory for the whole cloud.
constexpr std::size_t kBricksAtATime = 1024;

}  // namespace

void setRegions(RenderedView& view, const RegionTable& table) {
  view.regions.resize(view.fragments.size());
  std::ranges::transform(view.fragments, view.regions.begin(),
                         [&](FragmentId fragment) { return table.regionOf(fragment); });
}

Result<RenderedView> MapReadout::renderView(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K) {
  return guarded("rendering the map", [&]() -> Result<RenderedView> {
    SurfaceMaps surface;
    return render(T_world_camera, K, surface);
  });
}

RenderedView MapReadout::render(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K,
                                SurfaceMaps& surface) {
  fusion_.map().raycast(T_world_camera, K, surface);
  RenderedView view = readView(compute_, surface);
  view.fragments = labels_.project(surface);
  labels_.projectEstimated(view);
  setRegions(view, labels_.table());
  return view;
}

Result<LabelCloud::Extract> MapReadout::extractCloud(std::span<const Eigen::Vector3i> bricks) {
  return guarded("reading out the label cloud", [&]() -> Result<LabelCloud::Extract> {
    return labels_.cloud().extract(bricks, fusion_.bricks(), truncation_vox_);
  });
}

std::vector<Eigen::Vector3i> MapReadout::allBricks() const {
  const BrickMap& bricks = fusion_.bricks();
  std::vector<Eigen::Vector3i> all;
  for (const int page : bricks.pagesByPosition()) {
    const std::vector<Eigen::Vector3i> in_page = bricks.bricksOfPage(page);
    all.insert(all.end(), in_page.begin(), in_page.end());
  }
  return all;
}

Result<void> MapReadout::forEachCloudPoint(const std::function<void(const LabelPoint&)>& visit) {
  std::vector<Eigen::Vector3i> batch;
  const auto visitBatch = [&]() -> Result<void> {
    const Result<LabelCloud::Extract> extract = extractCloud(std::exchange(batch, {}));
    if (!extract) return fail(extract.error());
    for (const LabelPoint& point : extract->points) visit(point);
    return {};
  };
  const BrickMap& bricks = fusion_.bricks();
  for (const int page : bricks.pagesByPosition()) {
    const std::vector<Eigen::Vector3i> in_page = bricks.bricksOfPage(page);
    batch.insert(batch.end(), in_page.begin(), in_page.end());
    if (batch.size() >= kBricksAtATime) SCANTROVE_TRY(visitBatch());
  }
  return visitBatch();
}

Result<RegionSamples> MapReadout::sampleRegions(const RegionTable& table) {
  RegionSamples samples;
  SCANTROVE_TRY(forEachCloudPoint([&](const LabelPoint& point) {
    if (const RegionId region = table.regionOf(FragmentId{point.fragment}))
      samples.add(region, {point.x, point.y, point.z}, {point.normal_x, point.normal_y, point.normal_z});
  }));
  return samples;
}

/// Fragments without a surface are not counted, and not freed either. Voxels beside the surface still hold
/// them, and show them again when depth moves the surface back. They are part of regions, borders and the
/// history of edits, so freeing them would change the labels of later frames.
MapReadout::RegionCount MapReadout::regionCount() {
  const std::vector<RegionId>& regions = labels_.table().regions();
  std::unordered_set<RegionId> with_surface;
  const Result<void> read = forEachCloudPoint([&](const LabelPoint& point) {
    if (point.fragment < regions.size()) with_surface.insert(regions[point.fragment]);
  });
  std::unordered_map<RegionId, std::int64_t> voxels;
  const std::vector<cl_int>& of_fragment = labels_.voxelsOfFragments();
  for (std::size_t fragment = 1; fragment < std::min(of_fragment.size(), regions.size()); ++fragment) {
    if (const RegionId region = regions[fragment]) voxels[region] += of_fragment[fragment];
  }
  RegionCount count;
  for (const auto& [region, of_region] : voxels) {
    if (read && !with_surface.contains(region)) continue;  // without a device only the voxels tell
    ++(of_region < kSmallFragmentVoxels ? count.small_fragments : count.regions);
  }
  return count;
}

Result<std::optional<SurfaceMesh>> MapReadout::extractMesh(const MeshProgress& may_continue) {
  return guarded("making a mesh of the map", [&]() -> Result<std::optional<SurfaceMesh>> {
    return scantrove::extractMesh(fusion_.bricks(), may_continue);
  });
}

}  // namespace scantrove
