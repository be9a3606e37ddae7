// What ScanPipeline does when a scan has ended and it looks at everything again.
#include "core/scan/guarded.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {
namespace {

DepthView depthOf(const std::vector<Eigen::Vector4f>& vertices_world, const Intrinsics& K,
                  const Eigen::Isometry3d& T_world_camera) {
  DepthView view{K, T_world_camera, cv::Mat::zeros(K.height, K.width, CV_32FC1)};
  const Eigen::RowVector4f depth_row = T_world_camera.inverse().matrix().row(2).cast<float>();
  auto* z_m = view.z_m.ptr<float>();
  for (const Eigen::Vector4f& vertex : vertices_world) *z_m++ = vertex.w() > 0 ? depth_row.dot(vertex) : 0.0F;
  return view;
}

}  // namespace

Result<RegionSamples> ScanPipeline::sampleRegions() {
  RegionSamples samples;
  SCANTROVE_TRY(forEachCloudPoint([&](const LabelPoint& point) {
    if (const RegionId region = table_.regionOf(FragmentId{point.fragment}))
      samples.add(region, {point.x, point.y, point.z}, {point.normal_x, point.normal_y, point.normal_z});
  }));
  return samples;
}

Result<void> ScanPipeline::beginLookingAgain() {
  if (!collector_) return {};
  Result<RegionSamples> known = sampleRegions();
  if (!known) return fail(known.error());
  judge_ = std::make_unique<RegionJudge>(params_.discovery, std::move(*known));
  collector_->beginLookingAgain();
  return {};
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

ScanPipeline::SeenAgain ScanPipeline::seeAgain(const RgbdFrame& frame,
                                               const Eigen::Isometry3d& T_world_camera,
                                               CandidateSource& finder) {
  SeenAgain seen;
  seen.result.pose.T_world_camera = T_world_camera;
  seen.result.regions = regionsSeenAgain(T_world_camera);
  readSurface(seen_again_, seen.result);
  seen.in_color = locateInColor(frame.color_camera, working_K_, T_world_camera, seen.result.vertices_world);
  seen.candidates = findCandidates(finder, seen.result,
                                   cluesOf(frame, T_world_camera, seen.in_color, seen.result.vertices_world));
  return seen;
}

Result<void> ScanPipeline::rate(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  return guarded("rating frame " + std::to_string(frame.index), [&]() -> Result<void> {
    if (!collector_ || !judge_) return {};
    collector_->rate(frame.index, seeAgain(frame, T_world_camera, *judge_).candidates);
    return {};
  });
}

std::vector<int> ScanPipeline::settleWholes() {
  return collector_ ? collector_->settleWholes() : std::vector<int>{};
}

Result<FrameObjects> ScanPipeline::lookAgain(const RgbdFrame& frame,
                                             const Eigen::Isometry3d& T_world_camera) {
  return guarded("looking again at frame " + std::to_string(frame.index), [&]() -> Result<FrameObjects> {
    if (!collector_ || !judge_) return FrameObjects{};
    const SeenAgain seen = seeAgain(frame, T_world_camera, *judge_);
    return collector_->collect(frame, seen.result.pose, seen.in_color, seen.candidates);
  });
}

std::vector<int> ScanPipeline::beginLastLooks() {
  return collector_ ? collector_->beginLastLooks() : std::vector<int>{};
}

void ScanPipeline::endLookingAgain() {
  if (!collector_ || !judge_) return;
  judge_.reset();
  seen_again_ = {};
  collector_->endLookingAgain();
}

}  // namespace scantrove
