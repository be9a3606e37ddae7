// What ScanPipeline does when a scan has ended and it looks at everything again.
#include "core/discovery/region_rules.h"
#include "core/scan/guarded.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {
namespace {

/// Regions do not change any more, and looks are as far apart as key frames are.
DiscoveryParams paramsOfSecondLook(DiscoveryParams params) {
  constexpr int kLooks = 2;
  params.persistent_frames = 1;
  params.whole_looks = kLooks;
  params.whole_angle_deg = 0;
  params.still_frames = 0;
  return params;
}

DepthView depthOf(const std::vector<Eigen::Vector4f>& vertices_world, const Intrinsics& K,
                  const Eigen::Isometry3d& T_world_camera) {
  DepthView view{K, T_world_camera, cv::Mat::zeros(K.height, K.width, CV_32FC1)};
  const Eigen::RowVector4f depth_row = T_world_camera.inverse().matrix().row(2).cast<float>();
  auto* z_m = view.z_m.ptr<float>();
  for (const Eigen::Vector4f& vertex : vertices_world) *z_m++ = vertex.w() > 0 ? depth_row.dot(vertex) : 0.0F;
  return view;
}

}  // namespace

Result<std::vector<int>> ScanPipeline::beginLookingAgain() {
  if (!collector_) return std::vector<int>{};
  known_regions_ = {};
  SCANTROVE_TRY(forEachCloudPoint([&](const LabelPoint& point) {
    if (const RegionId region = table_.regionOf(FragmentId{point.fragment}))
      known_regions_.add(region, {point.x, point.y, point.z},
                         {point.normal_x, point.normal_y, point.normal_z});
  }));
  collector_->judgeShapes([this](RegionId region) {
    const RegionSamples::Shape shape = known_regions_.shapeOf({region});
    // Of what was taken away the map knows nothing any more.
    return shape.box.size_m.isZero() || isShapedAsThing(shape.box, shape.bulge, params_.discovery);
  });
  finder_of_kept_ = makeRuleBasedFinder(paramsOfSecondLook(params_.discovery));
  return collector_->beginLookingAgain();
}

RegionMap ScanPipeline::regionsSeenAgain(const Eigen::Isometry3d& T_world_camera) {
  map_->raycast(T_world_camera, working_K_, seen_again_);
  RegionMap map;
  map.width = working_K_.width;
  map.height = working_K_.height;
  map.regions.reserve(static_cast<std::size_t>(working_K_.pixels()));
  for (const FragmentId fragment : cloud_->project(seen_again_, map_->bricks()))
    map.regions.push_back(table_.regionOf(fragment));
  return map;
}

Result<void> ScanPipeline::judgeViewsOf(int frame_index) {
  return guarded("looking again at the views of frame " + std::to_string(frame_index), [&]() -> Result<void> {
    if (!collector_) return {};
    const std::optional<Eigen::Isometry3d> T_world_camera = collector_->cameraOfViews(frame_index);
    if (!T_world_camera) return {};
    const RegionMap now = regionsSeenAgain(*T_world_camera);
    FrameResult result;
    readSurface(seen_again_, result);
    collector_->judgeViewsOf(frame_index, now, depthOf(result.vertices_world, working_K_, *T_world_camera),
                             params_.fusion.depth_noise_m);
    return {};
  });
}

Result<FrameObjects> ScanPipeline::lookAgain(const RgbdFrame& frame,
                                             const Eigen::Isometry3d& T_world_camera) {
  return guarded("looking again at frame " + std::to_string(frame.index), [&]() -> Result<FrameObjects> {
    if (!collector_ || !finder_of_kept_) return FrameObjects{};
    FrameResult result;
    result.pose.T_world_camera = T_world_camera;
    result.regions = regionsSeenAgain(T_world_camera);
    readSurface(seen_again_, result);
    const SurfaceInColor in_color =
        locateInColor(frame.color_camera, working_K_, T_world_camera, result.vertices_world);
    const Readings readings = readingsOf(frame, T_world_camera, result.vertices_world);
    return collector_->collect(frame, result.pose, in_color,
                               findCandidates(*finder_of_kept_, result, readings));
  });
}

std::vector<int> ScanPipeline::beginLastLooks() {
  return collector_ ? collector_->beginLastLooks() : std::vector<int>{};
}

void ScanPipeline::endLookingAgain() {
  if (!collector_ || !finder_of_kept_) return;
  finder_of_kept_.reset();
  seen_again_ = {};
  known_regions_ = {};
  collector_->endLookingAgain();
}

}  // namespace scantrove
