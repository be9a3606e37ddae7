#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "core/base/stage_timer.h"
#include "core/fusion/dense_map.h"
#include "core/fusion/depth_preprocessor.h"
#include "core/fusion/motion_filter.h"
#include "core/tracking/pose_tracker.h"

namespace scantrove::test {

/// Depth filter, tracker, motion filter and map only.
class TrackingRig {
 public:
  /// `K`: of the depth images. Throws where create() fails.
  TrackingRig(ComputeContext& compute, const Intrinsics& K,
              PoseTracker::Predictor predictor = PoseTracker::Predictor::camera)
      : compute_(compute),
        preprocessor_(std::move(DepthPreprocessor::create(compute, K, params_).value())),
        motion_(std::move(MotionFilter::create(compute, params_).value())),
        map_(std::move(DenseMap::create(compute, params_).value())),
        tracker_(std::move(PoseTracker::create(
                               compute, params_,
                               [this](const Eigen::Isometry3d& T, SurfaceMaps& surface) {
                                 map_->raycast(T, working_K_, surface);
                               },
                               predictor)
                               .value())) {}
  TrackingRig(const TrackingRig&) = delete;
  TrackingRig& operator=(const TrackingRig&) = delete;

  /// Tracks the frame and fuses it when its pose is usable.
  PoseEstimate show(const RgbdFrame& frame) {
    const DepthPyramid& depth = preprocessor_->process(frame);
    working_K_ = depth.levels.front().K;
    const PoseEstimate pose = timer_.time("track", [&] { return tracker_->track(frame, depth, reference_); });
    timer_.endFrame();
    if (!pose.usable()) return pose;
    map_->integrate(motion_->still(depth, pose.T_world_camera, KnownSurface(readView(compute_, model_))),
                    pose.T_world_camera);
    map_->raycast(pose.T_world_camera, working_K_, model_);
    motion_->apply(depth, map_->bricks(), model_);
    reference_ = motion_->settled(model_, map_->bricks());
    tracker_->addKeyFrame(frame, depth, model_);
    return pose;
  }

  /// Fuses earlier frames that got a pose only with the last one. Result: their indexes and poses.
  std::vector<std::pair<int, PoseEstimate>> takeLateFrames() {
    std::vector<std::pair<int, PoseEstimate>> late;
    for (PoseTracker::UncertainFrame& uncertain : tracker_->takeUncertain()) {
      const int index = uncertain.frame.index;
      const DepthPyramid& depth = preprocessor_->process(uncertain.frame);
      const PoseEstimate pose = tracker_->reconsider(std::move(uncertain), depth);
      if (!pose.usable()) continue;
      map_->integrate(motion_->still(depth, pose.T_world_camera, KnownSurface(readView(compute_, model_))),
                      pose.T_world_camera);
      late.emplace_back(index, pose);
    }
    return late;
  }

  /// Times of track() by frame.
  [[nodiscard]] std::vector<double> trackTimes_ms() const { return timer_.stages().front().all_ms; }

 private:
  ComputeContext& compute_;
  FusionParams params_;
  Intrinsics working_K_;
  std::unique_ptr<DepthPreprocessor> preprocessor_;
  std::unique_ptr<MotionFilter> motion_;
  std::unique_ptr<DenseMap> map_;
  std::unique_ptr<PoseTracker> tracker_;
  SurfaceMaps model_, reference_;
  StageTimer timer_;
};

}  // namespace scantrove::test
