#include "core/scan/scan_pipeline.h"

#include <algorithm>
#include <future>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>

#include "core/compute/guarded.h"
#include "core/fusion/contradicted_surface.h"
#include "core/scan/map_memory.h"

namespace scantrove {
namespace {

PoseEstimate givenPose(const RgbdFrame& frame) {
  PoseEstimate pose;
  if (!frame.T_world_camera) return pose;
  pose.state = TrackingState::tracking;
  pose.T_world_camera = *frame.T_world_camera;
  pose.inlier_fraction = 1;
  return pose;
}

}  // namespace

Result<std::unique_ptr<ScanPipeline>> ScanPipeline::create(ComputeContext& compute, const Setup& setup) {
  SCANTROVE_TRY(checkMapFits(setup.params.fusion, setup.K, compute.memory()));
  std::unique_ptr<ScanPipeline> pipeline(new ScanPipeline(compute, setup));
  SCANTROVE_TRY(
      moveInto(pipeline->preprocessor_, DepthPreprocessor::create(compute, setup.K, setup.params.fusion)));
  pipeline->working_K_ = pipeline->preprocessor_->workingCamera();
  SCANTROVE_TRY(moveInto(pipeline->motion_, MotionFilter::create(compute, setup.params.fusion)));
  SCANTROVE_TRY(moveInto(pipeline->map_, DenseMap::create(compute, setup.params.fusion)));
  SCANTROVE_TRY(moveInto(pipeline->color_integrator_, ColorIntegrator::create(compute, setup.params.fusion)));
  if (!setup.poses_given) {
    const auto view_map = [&self = *pipeline](const Eigen::Isometry3d& T_world_camera, SurfaceMaps& surface) {
      self.map_->raycast(T_world_camera, self.working_K_, surface);
    };
    SCANTROVE_TRY(moveInto(pipeline->tracker_, PoseTracker::create(compute, setup.params.fusion, view_map)));
  }
  SCANTROVE_TRY(moveInto(pipeline->segmenter_, GraphSegmenter::create(compute)));
  SCANTROVE_TRY(moveInto(pipeline->cloud_, LabelCloud::create(compute)));
  pipeline->merger_ = makeRegionMerger(setup.params.labeling.rule);
  pipeline->editable_.emplace(*pipeline->cloud_, pipeline->map_->bricks(),
                              setup.params.fusion.truncation_vox);
  pipeline->editor_.emplace(pipeline->table_, *pipeline->merger_, *pipeline->editable_);
  pipeline->finder_ = makeRuleBasedFinder(setup.params.discovery);
  return pipeline;
}

FrameObservation ScanPipeline::observationOf(const RgbdFrame& frame, const RenderedView& view,
                                             SurfaceInColor in_color) const {
  FrameObservation observed;
  observed.color_lab = labColors(frame, view.K, in_color);
  observed.in_color = std::move(in_color);
  observed.depth = {view.K.resizedTo(frame.depth.cols, frame.depth.rows), view.T_world_camera, {}};
  frame.depth.convertTo(observed.depth.z_m, CV_32F, static_cast<double>(frame.meters_per_unit));
  observed.contradicted = contradictedSurface(observed.depth, view, params_.fusion.depth_noise_m);
  return observed;
}

template <class Work>
decltype(auto) ScanPipeline::stage(std::string_view name, Work&& work) {
  return timer_.time(name, std::forward<Work>(work));
}

Result<FrameResult> ScanPipeline::processFrame(const RgbdFrame& frame, const NextFrame& next) {
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

Error ScanPipeline::outOfMemory(int frame_index) const {
  // What a recording still has to show is taken to be like what it has shown.
  const double times = frame_count_ ? std::max(1.0, static_cast<double>(*frame_count_) / frames_) : 2.0;
  std::ostringstream voxels;
  voxels << voxelSizeFor(times, params_.fusion.voxel_size_m);
  return {"The OpenCL device " + compute_.deviceName() + " ran out of memory in frame " +
              std::to_string(frame_index) + ", with " + std::to_string(bricks().bricksHere()) +
              " bricks of map.",
          "What was scanned until then is kept. Scan " +
              std::string(frame_count_ ? "the whole recording" : "twice as much") +
              " with larger voxels: --set fusion.voxel_size_m=" + voxels.str() + "."};
}

std::pair<const DepthPyramid&, PoseEstimate> ScanPipeline::findPose(const RgbdFrame& frame) {
  if (next_attempt_.valid()) {
    // What is waited for here began beside the frame before.
    PoseTracker::TrackingAttempt attempt = stage("track", [&] { return next_attempt_.get(); });
    const DepthPyramid& depth = preprocessor_->pyramid();
    if (attempt.frame.index == frame.index && attempt.frame.depth.data == frame.depth.data)
      return {depth, stage("track", [&] { return tracker_->track(std::move(attempt), depth, followed_); })};
  }
  const auto prepare = [&]() -> const DepthPyramid& { return preprocessor_->process(frame); };
  const DepthPyramid& depth = stage("filter", prepare);
  const auto track = [&] { return tracker_ ? tracker_->track(frame, depth, followed_) : givenPose(frame); };
  return {depth, stage("track", track)};
}

void ScanPipeline::beginNext(const NextFrame& next) {
  // A frame that is looked at again needs the same buffers, and a profile one kernel after the other.
  if (!next || !tracker_ || tracker_->hasUncertain() || compute_.isProfiling()) return;
  const std::optional<RgbdFrame> frame = next();
  if (!frame) return;
  next_attempt_ = std::async(std::launch::async, [this, attempt = tracker_->beginAttempt(*frame)]() mutable {
    tracker_->registerToModel(attempt, preprocessor_->process(attempt.frame), followed_);
    return std::move(attempt);
  });
}

FrameResult ScanPipeline::runStages(const RgbdFrame& frame, const NextFrame& next) {
  FrameResult result;
  const std::pair<const DepthPyramid&, PoseEstimate> found = findPose(frame);
  const DepthPyramid& depth = found.first;
  working_K_ = depth.levels.front().K;
  result.pose = found.second;
  touched_ = {};
  has_pose_ = result.pose.usable();
  if (!has_pose_) return result;
  const Eigen::Isometry3d& T_world_camera = result.pose.T_world_camera;

  const DepthPyramid* still = nullptr;
  stage("filter", [&] { still = &motion_->still(depth, T_world_camera, known_); });
  stage("integrate", [&] { map_->integrate(*still, T_world_camera); });
  stage("raycast", [&] {
    map_->raycast(T_world_camera, working_K_, surface_);
    motion_->apply(depth, map_->bricks(), surface_);
    if (tracker_) followed_ = motion_->settled(surface_, map_->bricks());
  });
  if (tracker_) {
    stage("track", [&] { result.is_tracking_key_frame = tracker_->addKeyFrame(frame, depth, surface_); });
    result.returned = tracker_->takeReturned();
  }

  // The partition is one thread's; what does not need it goes on beside it.
  stage("segment", [&] { segmenter_->weigh(surface_, params_.segmentation); });
  std::future<SegmentMap> segments =
      std::async(std::launch::async, [this] { return segmenter_->partition(params_.segmentation); });
  stage("project", [&] {
    result.view = readView(compute_, surface_);
    result.view.fragments = cloud_->project(surface_, map_->bricks());
  });
  SurfaceInColor in_color = stage("color", [&] {
    return locateInColor(frame.color_camera, working_K_, T_world_camera, result.view.vertices_world);
  });
  const cv::Mat hidden = in_color.hidden;
  std::future<FrameObservation> observed = std::async(std::launch::async, [&] {
    known_ = KnownSurface(result.view);
    return observationOf(frame, result.view, std::move(in_color));
  });
  stage("color", [&] {
    color_integrator_->integrate(map_->bricks(), {surface_, result.view, depth, hidden}, frame);
  });
  beginNext(next);
  result.segments = stage("segment", [&] { return segments.get(); });
  result.observed = stage("color", [&] { return observed.get(); });
  RegionMerger::Outcome merged = stage("merge", [&] {
    return merger_->merge({result.segments, result.view, result.observed.color_lab,
                           cloud_->voxelsOfFragments(), appearedRegions()},
                          table_, params_.labeling);
  });
  touched_ = stage("update", [&] { return label(surface_, merged); });
  result.view.fragments = std::move(merged.fragments);
  result.view.regions = std::move(merged.regions);
  stage("discover", [&] { observations_.record(result.view, table_); });

  result.region_events = std::move(merged.events);
  follow(result.region_events);
  stage("discover", [&] { findCandidates(*finder_, table_, appearedRegions(), result); });
  if (tracker_) result.late = integrateLate();
  stage("integrate", [&] { map_->settle(); });
  return result;
}

std::span<const std::uint8_t> ScanPipeline::appearedRegions() {
  if (motion_->appeared().empty()) return {};
  cv::resize(motion_->appeared(), appeared_, {working_K_.width, working_K_.height}, 0, 0, cv::INTER_NEAREST);
  return {appeared_.ptr<std::uint8_t>(), appeared_.total()};
}

std::vector<LateFrame> ScanPipeline::integrateLate() {
  std::vector<LateFrame> late;
  for (PoseTracker::UncertainFrame& uncertain : tracker_->takeUncertain()) {
    LateFrame frame{uncertain.frame.index, uncertain.frame.timestamp_s, {}};
    const DepthPyramid* depth = nullptr;
    stage("filter", [&] { depth = &preprocessor_->process(uncertain.frame); });
    frame.pose = stage("track", [&] { return tracker_->reconsider(std::move(uncertain), *depth); });
    if (!frame.pose.usable()) continue;
    stage("integrate", [&] {
      map_->integrate(motion_->still(*depth, frame.pose.T_world_camera, known_), frame.pose.T_world_camera);
    });
    late.push_back(frame);
  }
  return late;
}

void ScanPipeline::findCandidates(CandidateSource& finder, const RegionTable& table,
                                  std::span<const std::uint8_t> appeared, FrameResult& result) const {
  const std::vector<RegionId> shown = result.shownRegions();
  DiscoveryInput input = result.inputFor(shown);
  input.joining_odds = [&](RegionId a, RegionId b) {
    constexpr float kNever = -std::numeric_limits<float>::infinity();
    return merger_->joiningOdds(a, b, table, cloud_->voxelsOfFragments(), params_.labeling).value_or(kNever);
  };
  input.appeared = appeared;
  result.candidates = finder.find(input);
  constexpr double kMinPart = 0.0005;  // of the image: less may be a rest of something
  const auto pixels = static_cast<double>(result.view.K.pixels());
  result.regions_in_view = finder.census().regionsOfSize(kMinPart * pixels);
}

void ScanPipeline::follow(const RegionEvents& events) {
  for (const auto& [into, from] : events.joined) finder_->regionsJoined(into, from);
  for (const auto& [from, part] : events.parted) finder_->regionParted(from);
}

void ScanPipeline::setKnown(const RegionSet& regions, Known known) {
  for (const RegionId region : regions) {
    table_.setKnown(region, known != Known::no);
    if (known == Known::one_thing) merger_->mustBeOne(*regions.begin(), region, table_);
  }
}

std::vector<RegionChange> ScanPipeline::takeRegionChanges() {
  std::vector<RegionChange> changes;
  for (const FragmentId fragment : table_.takeChanged())
    changes.push_back({fragment, table_.regionOf(fragment)});
  return changes;
}

std::vector<Eigen::Vector3f> ScanPipeline::labColors(const RgbdFrame& frame, const Intrinsics& K,
                                                     const SurfaceInColor& in_color) const {
  if (frame.color.empty()) return {};
  cv::Mat small, soft, lab;
  const cv::Size size(K.width, K.height);
  cv::resize(frame.color, small, size, 0, 0, cv::INTER_AREA);
  if (frame.color_camera) {
    cv::Mat seen;
    cv::remap(small, seen, pixelsOf(in_color.places, size), {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    small = seen;
  }
  cv::blur(small, soft, {3, 3});
  soft.convertTo(soft, CV_32F, 1.0 / 255);
  cv::cvtColor(soft, lab, cv::COLOR_BGR2Lab);
  static_assert(sizeof(cv::Vec3f) == sizeof(Eigen::Vector3f));
  const auto* first = reinterpret_cast<const Eigen::Vector3f*>(lab.ptr<float>());
  return {first, first + lab.total()};
}

std::span<const Eigen::Vector3i> ScanPipeline::label(const SurfaceMaps& surface,
                                                     const RegionMerger::Outcome& merged) {
  for (std::size_t i = 0; i < merged.split_off.size(); ++i)
    editor_->splitOff(merged.split_off[i], merged.split_from[i]);
  const std::span<const Eigen::Vector3i> touched =
      cloud_->update(surface, merged.fragments, merged.split_off, params_.labeling, map_->bricks());
  forgetFragments();
  return touched;
}

void ScanPipeline::forgetFragments() {
  const std::vector<cl_int>& voxels = cloud_->voxelsOfFragments();
  for (std::uint32_t fragment = 1; fragment < table_.regions().size(); ++fragment) {
    if (!table_.regions()[fragment] || (fragment < voxels.size() && voxels[fragment] > 0)) continue;
    merger_->forget(FragmentId{fragment});
    editor_->forget(FragmentId{fragment});
    table_.free(FragmentId{fragment});
  }
}

void ScanPipeline::setParams(const ScanParams& params) {
  const FusionParams fusion = params_.fusion;
  const LabelingParams::Rule rule = params_.labeling.rule;
  params_ = params;
  params_.fusion = fusion;
  if (params.labeling.rule != rule) {
    merger_ = makeRegionMerger(params.labeling.rule);
    editor_->useMerger(*merger_);
  }
  finder_->setParams(params_.discovery);
}

std::size_t ScanPipeline::deviceBytes() const { return map_->bricks().deviceBytes(); }

}  // namespace scantrove
