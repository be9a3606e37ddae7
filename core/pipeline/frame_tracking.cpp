#include "core/pipeline/frame_tracking.h"

#include <utility>

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

Result<std::unique_ptr<FrameTracking>> FrameTracking::create(ComputeContext& compute, DenseMap& map,
                                                             StageTimer& timer, const Setup& setup) {
  std::unique_ptr<FrameTracking> tracking(new FrameTracking(compute, timer, setup));
  SCANTROVE_TRY(moveInto(tracking->preprocessor_, DepthPreprocessor::create(compute, setup.K, setup.params)));
  tracking->K_ = tracking->intrinsicsOf(std::nullopt);
  if (setup.poses == PoseUse::given) return tracking;
  const auto view_map = [&map, &self = *tracking](const Eigen::Isometry3d& T_world_camera,
                                                  SurfaceMaps& surface) {
    map.raycast(T_world_camera, self.K_, surface);
  };
  using enum PoseTracker::Predictor;
  SCANTROVE_TRY(
      moveInto(tracking->tracker_,
               PoseTracker::create(compute, setup.params, view_map,
                                   setup.poses == PoseUse::predicted ? device : camera, setup.filled_part)));
  return tracking;
}

RgbdFrame FrameTracking::withIntrinsics(const RgbdFrame& frame) const {
  RgbdFrame own = frame;
  if (!own.intrinsics) own.intrinsics = setup_.K;
  return own;
}

const DepthPyramid& FrameTracking::prepare(const RgbdFrame& frame) {
  const DepthPyramid& depth = preprocessor_->process(frame);
  K_ = depth.levels.front().K;
  return depth;
}

FrameTracking::Located FrameTracking::locate(const RgbdFrame& frame) {
  const auto located = [this](const DepthPyramid& depth, const auto& track) {
    Located result{depth, timer_.time("track", track)};
    K_ = depth.levels.front().K;
    return result;
  };
  if (next_.valid()) {
    // The work that is awaited here started beside the previous frame.
    PoseTracker::TrackingAttempt attempt = timer_.time("track", [&] { return next_.get(); });
    const DepthPyramid& depth = preprocessor_->pyramid();
    const RgbdFrame& begun = attempt.clues.frame;
    if (begun.index == frame.index && begun.depth.data == frame.depth.data)
      return located(depth, [&] { return tracker_->track(std::move(attempt), depth, reference_); });
  }
  const DepthPyramid& depth =
      timer_.time("filter", [&]() -> const DepthPyramid& { return preprocessor_->process(frame); });
  return located(depth, [&] {
    return tracker_ ? tracker_->track(withIntrinsics(frame), depth, reference_) : givenPose(frame);
  });
}

void FrameTracking::beginNext(const NextFrame& next) {
  // Reconsidering a frame needs the same buffers, and a profile needs one kernel after the other.
  if (!next || !tracker_ || tracker_->hasUncertain() || compute_.isProfiling()) return;
  const std::optional<RgbdFrame> frame = next();
  if (!frame) return;
  next_ = std::async(
      std::launch::async, [this, attempt = tracker_->beginAttempt(withIntrinsics(*frame))]() mutable {
        tracker_->registerToModel(attempt, preprocessor_->process(attempt.clues.frame), reference_);
        return std::move(attempt);
      });
}

FrameTracking::KeyFrameOutcome FrameTracking::addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth,
                                                          const SurfaceMaps& surface) {
  if (!tracker_) return {};
  KeyFrameOutcome outcome;
  outcome.is_key_frame =
      timer_.time("track", [&] { return tracker_->addKeyFrame(withIntrinsics(frame), depth, surface); });
  outcome.returned = tracker_->takeReturned();
  return outcome;
}

std::vector<LateFrame> FrameTracking::reconsider(const Integrate& integrate) {
  std::vector<LateFrame> late;
  if (!tracker_) return late;
  for (PoseTracker::UncertainFrame& uncertain : tracker_->takeUncertain()) {
    LateFrame frame{uncertain.frame.index, uncertain.frame.timestamp_s, {}};
    const DepthPyramid& depth = timer_.time(
        "filter", [&]() -> const DepthPyramid& { return preprocessor_->process(uncertain.frame); });
    frame.pose = timer_.time("track", [&] { return tracker_->reconsider(std::move(uncertain), depth); });
    if (!frame.pose.usable()) continue;
    integrate(depth, frame.pose.T_world_camera);
    late.push_back(frame);
  }
  return late;
}

void FrameTracking::awaitNext() {
  if (next_.valid()) next_.wait();
}

}  // namespace scantrove
