// What ScanPipeline does when a scan has ended and it looks at everything again.
#include <algorithm>
#include <iterator>

#include "core/compute/guarded.h"
#include "core/scan/scan_pipeline.h"

namespace scantrove {
namespace {

/// Of RatedSets: a set of this objectness is about as likely to be a complete object as not; below, an object
/// is dropped. Of the sets between this and even odds about half are complete in random rooms.
constexpr float kComplete = -0.2F;

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

FinerRegions ScanPipeline::finerRegions() const {
  const auto stays = [this](RegionId region) { return collector_ && collector_->staysAsItIs(region); };
  return {table_, *merger_, cloud_->voxelsOfFragments(), params_.labeling, stays};
}

Result<void> ScanPipeline::segmentCloser(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  return guarded("segmenting frame " + std::to_string(frame.index) + " more closely", [&]() -> Result<void> {
    if (params_.labeling.rule != LabelingParams::Rule::graph) return {};
    const SeenAgain seen = seeAgain(frame, T_world_camera);
    const SegmentMap segments = segmenter_->segment(seen_again_, params_.segmentation);
    const RegionMerger::Outcome merged = merger_->merge(
        {segments, seen.view, seen.clues.lab, cloud_->voxelsOfFragments()}, table_, params_.labeling);
    static_cast<void>(label(seen_again_, merged));
    tellOf(merged.events, ObjectCollector::JoinedBy::frames);
    return {};
  });
}

Result<void> ScanPipeline::beginLookingAgain() {
  if (!collector_) return {};
  Result<RegionSamples> known = sampleRegions();
  if (!known) return fail(known.error());
  judge_ = std::make_unique<RegionJudge>(params_.discovery, std::move(*known));
  finer_ = finerRegions();
  if (finer_->areDivided()) {
    Result<RegionSamples> of_parts = sampleRegions(finer_->table());
    if (!of_parts) return fail(of_parts.error());
    finer_judge_ = std::make_unique<RegionJudge>(params_.discovery, std::move(*of_parts));
    // What holds no part is rated as it is.
    finer_judge_->askOnlyOf(
        [&finer = *finer_](const RegionSet& regions) { return finer.holdsPart(regions); });
  }
  rated_ = {};
  collector_->beginLookingAgain();
  return {};
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

Result<void> ScanPipeline::judgeViewsOf(int frame_index) {
  return guarded("looking again at the views of frame " + std::to_string(frame_index), [&]() -> Result<void> {
    if (!collector_) return {};
    for (const auto& [image_px, T_world_camera] : collector_->camerasOfViews(frame_index)) {
      const Intrinsics K = working_K_.resizedTo(image_px.width, image_px.height);
      collector_->judgeViewsOf(frame_index, render(K, T_world_camera, seen_again_),
                               params_.fusion.depth_noise_m);
    }
    return {};
  });
}

ScanPipeline::SeenAgain ScanPipeline::seeAgain(const RgbdFrame& frame,
                                               const Eigen::Isometry3d& T_world_camera) {
  SeenAgain seen;
  seen.view = render(closeCamera(frame.depth.size()), T_world_camera, seen_again_);
  seen.in_color = locateInColor(frame.color_camera, seen.view.K, T_world_camera, seen.view.vertices_world);
  seen.clues = cluesOf(frame, seen.view, seen.in_color);
  return seen;
}

std::vector<Candidate> ScanPipeline::findAgain(SeenAgain& seen, CandidateSource& finder,
                                               const RegionTable& table) {
  setRegions(seen.view, table);
  return findCandidates(finder, seen.view, seen.clues, table);
}

Result<void> ScanPipeline::rate(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  return guarded("rating frame " + std::to_string(frame.index), [&]() -> Result<void> {
    if (!collector_ || !judge_) return {};
    SeenAgain seen = seeAgain(frame, T_world_camera);
    std::vector<Candidate> candidates = findAgain(seen, *judge_, table_);
    if (finer_judge_) {
      // All in finer regions.
      for (Candidate& candidate : candidates) candidate.regions = finer_->partsOf(candidate.regions);
      std::ranges::move(findAgain(seen, *finer_judge_, finer_->table()), std::back_inserter(candidates));
    }
    rated_.add(frame.index, candidates);
    return {};
  });
}

Result<void> ScanPipeline::partWholes() {
  RegionEvents events;
  std::vector<RegionSet> complete;
  for (const RatedSets::Rated& rated : rated_.disjoint(kComplete)) complete.push_back(rated.regions);
  finer_->apply(complete, table_, *merger_, cloud_->voxelsOfFragments(), events);
  rated_.rename([this](const RegionSet& rated) { return finer_->regionsOf(rated, table_); });
  finer_judge_.reset();
  finer_.reset();
  if (events.parted.empty()) return {};
  tellOf(events, ObjectCollector::JoinedBy::frames);
  Result<RegionSamples> known = sampleRegions();
  if (!known) return fail(known.error());
  judge_ = std::make_unique<RegionJudge>(params_.discovery, std::move(*known));
  return {};
}

Result<void> ScanPipeline::settleWholes() {
  if (!collector_) return {};
  if (finer_judge_) SCANTROVE_TRY(partWholes());
  std::vector<ObjectCollector::CompleteSet> complete;
  for (const RatedSets::Rated& rated : rated_.disjoint(kComplete))
    complete.push_back({rated.regions, rated.frame_index});
  collector_->settleComplete(complete,
                             [this](RegionId region) { return rated_.isUnlikely(region, kComplete); });
  judge_->askOnlyOf([this](const RegionSet& regions) { return collector_->mayBeObject(regions); });
  return {};
}

Result<void> ScanPipeline::resumeLookingAgain() {
  if (!collector_) return {};
  Result<RegionSamples> known = sampleRegions();
  if (!known) return fail(known.error());
  judge_ = std::make_unique<RegionJudge>(params_.discovery, std::move(*known));
  judge_->askOnlyOf([this](const RegionSet& regions) { return collector_->mayBeObject(regions); });
  return {};
}

std::vector<int> ScanPipeline::framesOfViews() const {
  return collector_ ? collector_->framesOfViews() : std::vector<int>{};
}

Result<FrameObjects> ScanPipeline::lookAgain(const RgbdFrame& frame,
                                             const Eigen::Isometry3d& T_world_camera) {
  return guarded("looking again at frame " + std::to_string(frame.index), [&]() -> Result<FrameObjects> {
    if (!collector_ || !judge_) return FrameObjects{};
    SeenAgain seen = seeAgain(frame, T_world_camera);
    PoseEstimate pose;
    pose.T_world_camera = T_world_camera;
    return collector_->collect(frame, pose, seen.in_color, findAgain(seen, *judge_, table_));
  });
}

std::vector<int> ScanPipeline::beginLastLooks() {
  return collector_ ? collector_->beginLastLooks() : std::vector<int>{};
}

void ScanPipeline::endLookingAgain() {
  if (!collector_ || !judge_) return;
  judge_.reset();
  finer_judge_.reset();
  finer_.reset();
  seen_again_ = {};
  rated_ = {};
  collector_->endLookingAgain();
}

}  // namespace scantrove
