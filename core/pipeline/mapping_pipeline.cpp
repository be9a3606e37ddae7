#include "core/pipeline/mapping_pipeline.h"

#include <algorithm>
#include <future>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "core/compute/guarded.h"
#include "core/discovery/region_candidate.h"
#include "core/discovery/rule_based_finder.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/sensor_fit.h"
#include "core/pipeline/map_memory.h"
#include "core/segmentation/supported_segments.h"

namespace scantrove {

Result<std::unique_ptr<MappingPipeline>> MappingPipeline::create(ComputeContext& compute,
                                                                 const Setup& asked) {
  Setup setup = asked;
  setup.params.fusion = fitToSensor(setup.params.fusion, {setup.K, std::nullopt});
  setup.params.labeling.reach_of_depth = std::numbers::sqrt2_v<float> / 2 / setup.K.fx;
  const MappingParams& params = setup.params;
  SCANTROVE_TRY(checkMapFits(params.fusion, setup.K, compute.memory()));
  std::unique_ptr<MappingPipeline> pipeline(new MappingPipeline(compute, setup));
  SCANTROVE_TRY(moveInto(pipeline->fusion_, MapFusion::create(compute, pipeline->timer_, params.fusion)));
  SCANTROVE_TRY(moveInto(pipeline->tracking_,
                         FrameTracking::create(compute, pipeline->fusion_->map(), pipeline->timer_,
                                               {setup.K, params.fusion, setup.poses, setup.filled_part})));
  SCANTROVE_TRY(moveInto(pipeline->segmenter_, GraphSegmenter::create(compute)));
  SCANTROVE_TRY(
      moveInto(pipeline->labels_, MapLabels::create(compute, pipeline->fusion_->bricks(),
                                                    {params.fusion.truncation_vox, params.labeling.rule})));
  pipeline->finder_ = makeRuleBasedFinder(params.discovery);
  pipeline->readout_.emplace(compute, *pipeline->fusion_, *pipeline->labels_, params.fusion.truncation_vox);
  pipeline->camera_.emplace(compute, *pipeline->tracking_, *pipeline->fusion_);
  return pipeline;
}

Result<FrameResult> MappingPipeline::processFrame(const RgbdFrame& frame, const NextFrame& next) {
  ++frames_;
  return guarded("in frame " + std::to_string(frame.index), [&]() -> Result<FrameResult> {
    try {
      return runStages(frame, next);
    } catch (const cl::Error& error) {
      if (!isOutOfMemory(error)) throw;
      return fail(outOfMemory(frame.index));
    }
  });
}

Error MappingPipeline::outOfMemory(int frame_index) const {
  // Extrapolates the rest of a recording from its processed part.
  const double times = frame_count_ ? std::max(1.0, static_cast<double>(*frame_count_) / frames_) : 2.0;
  std::ostringstream voxels;
  voxels << voxelSizeFor(times, params_.fusion.voxel_size_m);
  return {"The OpenCL device " + compute_.deviceName() + " ran out of memory in frame " +
              std::to_string(frame_index) + ", with " + std::to_string(bricks().device().brickCount()) +
              " bricks of map.",
          "What was scanned until then is kept. Scan " +
              std::string(frame_count_ ? "the whole recording" : "twice as much") +
              " with larger voxels: --set fusion.voxel_size_m=" + voxels.str() + "."};
}

FrameResult MappingPipeline::runStages(const RgbdFrame& frame, const NextFrame& next) {
  FrameResult result;
  touched_ = {};
  has_pose_ = false;
  const FrameTracking::Located located = tracking_->locate(frame);
  const DepthPyramid& depth = located.depth;
  result.pose = located.pose;
  has_pose_ = result.pose.usable();
  if (!has_pose_) return result;
  const Eigen::Isometry3d& T_world_camera = result.pose.T_world_camera;
  const Intrinsics& K = tracking_->intrinsics();
  const SurfaceMaps& surface = fusion_->surface();

  fusion_->integrate(depth, T_world_camera);
  timer_.time("raycast", [&] {
    fusion_->raycast(depth, T_world_camera, K);
    if (tracking_->tracker() != nullptr) tracking_->setReference(fusion_->settledSurface());
  });
  const FrameTracking::KeyFrameOutcome outcome = tracking_->addKeyFrame(frame, depth, surface);
  result.is_tracking_key_frame = outcome.is_key_frame;
  result.returned = outcome.returned;

  // The partition uses one thread; independent work runs beside it.
  timer_.time("segment", [&] { segmenter_->weigh(surface, params_.segmentation); });
  struct Partition {
    SegmentMap segments;
    std::vector<Support> supports;
  };
  std::future<Partition> partition = std::async(std::launch::async, [&] {
    SegmentMap segments = segmenter_->partition(params_.segmentation);
    std::vector<Support> supports = supportsOf(segments, K);
    return Partition{std::move(segments), std::move(supports)};
  });
  timer_.time("project", [&] {
    result.view = readView(compute_, surface);
    result.view.fragments = labels_->project(surface);
  });
  SurfaceInColor in_color =
      timer_.time("color", [&] { return locateInColor(frame.color_camera, result.view); });
  const cv::Mat hidden = in_color.hidden;
  std::future<FrameObservation> observed = std::async(std::launch::async, [&] {
    fusion_->remember(result.view);
    return scantrove::observe(frame, result.view, std::move(in_color), params_.fusion.depth_noise_m);
  });
  timer_.time("color", [&] { fusion_->integrateColor(frame, result.view, depth, hidden); });
  tracking_->beginNext(next);
  const std::vector<Support> supports = timer_.time("segment", [&] {
    Partition done = partition.get();
    result.segments = std::move(done.segments);
    return std::move(done.supports);
  });
  result.observed = timer_.time("color", [&] { return observed.get(); });
  timer_.time("support", [&] {
    labels_->projectEstimated(result.view);
    segmentOnSupports(supports, result.observed.color_lab, K, result.segments);
    addEstimatedSurface(result.segments, result.view);
    color_lab_ = result.observed.color_lab;
  });

  const std::span<const std::uint8_t> newly_appeared = fusion_->newlyAppeared();
  RegionMerger::Outcome merged = timer_.time("merge", [&] {
    return labels_->merge(result.segments, result.view, result.observed.color_lab, newly_appeared,
                          params_.labeling);
  });
  touched_ = timer_.time("update", [&] { return labels_->update(surface, merged, params_.labeling); });
  result.view.fragments = std::move(merged.fragments);
  result.view.regions = std::move(merged.regions);
  labels_->updateEstimated(result.view, result.segments);
  result.region_events = std::move(merged.events);
  timer_.time("discover", [&] {
    labels_->recordDirections(result.view);
    labels_->recordSupports(result.segments, result.view);
    applyRegionEvents(result.region_events);
    findCandidates(*finder_, labels_->table(), newly_appeared, result);
  });

  result.late = tracking_->reconsider(
      [this](const DepthPyramid& late, const Eigen::Isometry3d& T) { fusion_->integrate(late, T); });
  timer_.time("integrate", [&] { fusion_->settle(); });
  return result;
}

std::vector<Support> MappingPipeline::supportsOf(const SegmentMap& segments, const Intrinsics& K) const {
  if (params_.labeling.rule != LabelingParams::Rule::graph) return {};
  if (params_.segmentation.rule == SegmentationParams::Rule::whole) return {};
  return findSupports(segments, K);
}

void MappingPipeline::findCandidates(CandidateSource& finder, const RegionTable& table,
                                     std::span<const std::uint8_t> newly_appeared,
                                     FrameResult& result) const {
  const std::vector<RegionId> shown = result.shownRegions();
  DiscoveryInput input = result.inputFor(shown);
  input.joining_odds = [&](RegionId a, RegionId b) {
    return labels_->joiningOdds(a, b, table, params_.labeling);
  };
  input.support_shares = [&](RegionId region) {
    SupportPixels pixels;
    for (const FragmentId fragment : table.fragmentsOf(region))
      pixels += labels_->table().supportPixels(fragment);
    const float seen = std::max(pixels.seen, 1.0F);
    return SupportShares{pixels.support / seen, pixels.carried / seen};
  };
  input.appeared = newly_appeared;
  result.candidates = finder.find(input);
  constexpr double kMinPart = 0.0005;  // of the image: a smaller part may be a remnant
  const auto pixels = static_cast<double>(result.view.K.pixels());
  result.regions_in_view = finder.census().regionsOfSize(kMinPart * pixels);
  if (params_.segmentation.rule != SegmentationParams::Rule::whole) return;
  const auto least_points = static_cast<int>(params_.discovery.min_points * result.view.K.pixelScale());
  result.candidates.clear();
  if (std::optional<Candidate> object = onlyObject(finder.census(), input, least_points)) {
    object->is_complete = frames_ >= params_.discovery.persistent_frames && !object->is_cut_off;
    result.candidates.push_back(std::move(*object));
  }
}

void MappingPipeline::findCandidates(CandidateSource& finder, const RegionTable& table,
                                     FrameResult& observed) const {
  setRegions(observed.view, table);
  findCandidates(finder, table, {}, observed);
  if (params_.segmentation.rule != SegmentationParams::Rule::whole) return;
  constexpr float kCertain = 5;  // log-odds
  for (Candidate& object : observed.candidates) object.objectness = kCertain;
}

void MappingPipeline::applyRegionEvents(const RegionEvents& events) {
  for (const auto& [into, from] : events.joined) finder_->regionsJoined(into, from);
  for (const auto& [from, part] : events.parted) finder_->regionParted(from);
}

Result<RegionEditor::Outcome> MappingPipeline::edit(const Operation& operation,
                                                    const PaintedSurface* painted) {
  Operation numbered = operation;
  numbered.frame = frames_;
  return guarded("editing the regions",
                 [&] { return applied(labels_->editor().apply(numbered, params_.labeling, painted)); });
}

Result<RegionEditor::Outcome> MappingPipeline::undo() {
  return guarded("undoing", [&] { return applied(labels_->editor().undo()); });
}

Result<RegionEditor::Outcome> MappingPipeline::redo() {
  return guarded("doing it again", [&] { return applied(labels_->editor().redo()); });
}

Result<RegionEditor::Outcome> MappingPipeline::applied(Result<RegionEditor::Outcome> outcome) {
  if (outcome) applyRegionEvents(outcome->events);
  return outcome;
}

Result<RegionEvents> MappingPipeline::segmentCloser(const RgbdFrame& frame,
                                                    const Eigen::Isometry3d& T_world_camera) {
  const auto segment = [&]() -> Result<RegionEvents> {
    if (params_.labeling.rule != LabelingParams::Rule::graph) return RegionEvents{};
    FrameResult seen = observe(frame, T_world_camera);
    SegmentMap segments = segmenter_->segment(observed_, params_.segmentation);
    segmentOnSupports(supportsOf(segments, seen.view.K), seen.observed.color_lab, seen.view.K, segments);
    addEstimatedSurface(segments, seen.view);
    RegionMerger::Outcome merged =
        labels_->merge(segments, seen.view, seen.observed.color_lab, {}, params_.labeling);
    labels_->update(observed_, merged, params_.labeling);
    seen.view.fragments = std::move(merged.fragments);
    labels_->updateEstimated(seen.view, segments);
    labels_->recordSupports(segments, seen.view);
    applyRegionEvents(merged.events);
    return std::move(merged.events);
  };
  return guarded("segmenting frame " + std::to_string(frame.index) + " more closely", segment);
}

Intrinsics MappingPipeline::closeCamera(const RgbdFrame& frame) const {
  constexpr int kCloser = 2;
  const Intrinsics K = workingIntrinsicsOf(frame.intrinsics);
  const int width = std::min(frame.depth.cols, kCloser * K.width);
  if (width <= K.width) return K;
  return K.resizedTo(width, (width * K.height + K.width / 2) / K.width);
}

FrameResult MappingPipeline::observe(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  FrameResult seen;
  seen.pose.T_world_camera = T_world_camera;
  seen.view = readout_->render(T_world_camera, closeCamera(frame), observed_);
  SurfaceInColor in_color = locateInColor(frame.color_camera, seen.view);
  seen.observed = scantrove::observe(frame, seen.view, std::move(in_color), params_.fusion.depth_noise_m);
  return seen;
}

Result<SegmentMap> MappingPipeline::segmentAgain() {
  return guarded("segmenting the frame again", [&]() -> Result<SegmentMap> {
    if (!has_pose_) return SegmentMap{};
    SegmentMap segments = segmenter_->segment(fusion_->surface(), params_.segmentation);
    const Intrinsics& K = fusion_->surface().K;
    segmentOnSupports(supportsOf(segments, K), color_lab_, K, segments);
    return segments;
  });
}

Result<SegmentMap> MappingPipeline::segmentMapFrom(const Eigen::Isometry3d& T_world_camera,
                                                   const Intrinsics& K, const SegmentationParams& params) {
  return guarded("segmenting a view of the map", [&]() -> Result<SegmentMap> {
    SurfaceMaps surface;
    fusion_->map().raycast(T_world_camera, K, surface);
    return segmenter_->segment(surface, params);
  });
}

void MappingPipeline::setParams(const MappingParams& params) {
  const FusionParams fusion = params_.fusion;
  const float reach_of_depth = params_.labeling.reach_of_depth;
  if (params.labeling.rule != params_.labeling.rule) labels_->setRule(params.labeling.rule);
  params_ = params;
  params_.fusion = fusion;
  params_.labeling.reach_of_depth = reach_of_depth;
  finder_->setParams(params_.discovery);
}

}  // namespace scantrove
