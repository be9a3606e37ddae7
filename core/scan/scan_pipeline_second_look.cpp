// What ScanPipeline shows of earlier frames once a scan has ended.
#include <algorithm>
#include <utility>

#include "core/compute/guarded.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {
namespace {

void setRegions(RenderedView& view, const RegionTable& table) {
  view.regions.resize(view.fragments.size());
  std::ranges::transform(view.fragments, view.regions.begin(),
                         [&](FragmentId fragment) { return table.regionOf(fragment); });
}

}  // namespace

Result<RegionSamples> ScanPipeline::sampleRegions(const RegionTable& table) {
  RegionSamples samples;
  SCANTROVE_TRY(forEachCloudPoint([&](const LabelPoint& point) {
    if (const RegionId region = table.regionOf(FragmentId{point.fragment}))
      samples.add(region, {point.x, point.y, point.z}, {point.normal_x, point.normal_y, point.normal_z});
  }));
  return samples;
}

Result<RegionEvents> ScanPipeline::segmentCloser(const RgbdFrame& frame,
                                                 const Eigen::Isometry3d& T_world_camera) {
  const auto segment = [&]() -> Result<RegionEvents> {
    if (params_.labeling.rule != LabelingParams::Rule::graph) return RegionEvents{};
    const FrameResult seen = observe(frame, T_world_camera);
    const SegmentMap segments = segmenter_->segment(observed_, params_.segmentation);
    RegionMerger::Outcome merged =
        merger_->merge({segments, seen.view, seen.observed.color_lab, cloud_->voxelsOfFragments()}, table_,
                       params_.labeling);
    static_cast<void>(label(observed_, merged));
    follow(merged.events);
    return std::move(merged.events);
  };
  return guarded("segmenting frame " + std::to_string(frame.index) + " more closely", segment);
}

Intrinsics ScanPipeline::closeCamera(const cv::Size& depth) const {
  constexpr int kCloser = 2;
  const int width = std::min(depth.width, kCloser * working_K_.width);
  if (width <= working_K_.width) return working_K_;
  return working_K_.resizedTo(width, (width * working_K_.height + working_K_.width / 2) / working_K_.width);
}

RenderedView ScanPipeline::render(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
                                  SurfaceMaps& surface) {
  map_->raycast(T_world_camera, K, surface);
  RenderedView view = readView(compute_, surface);
  view.fragments = cloud_->project(surface, map_->bricks());
  setRegions(view, table_);
  return view;
}

FrameResult ScanPipeline::observe(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  FrameResult seen;
  seen.pose.T_world_camera = T_world_camera;
  seen.view = render(closeCamera(frame.depth.size()), T_world_camera, observed_);
  seen.observed =
      observationOf(frame, seen.view,
                    locateInColor(frame.color_camera, seen.view.K, T_world_camera, seen.view.vertices_world));
  return seen;
}

void ScanPipeline::findCandidates(CandidateSource& finder, const RegionTable& table,
                                  FrameResult& observed) const {
  setRegions(observed.view, table);
  findCandidates(finder, table, {}, observed);
}

RegionEvents ScanPipeline::divide(const FinerRegions& finer, std::span<const RegionSet> parts) {
  RegionEvents events;
  finer.apply(parts, table_, *merger_, cloud_->voxelsOfFragments(), events);
  follow(events);
  return events;
}

}  // namespace scantrove
