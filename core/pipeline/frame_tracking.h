#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/stage_timer.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/dense_map.h"
#include "core/fusion/depth_preprocessor.h"
#include "core/pipeline/frame_result.h"
#include "core/tracking/pose_tracker.h"

namespace scantrove {

/// Where each frame was taken: prepares its depth, and tracks the camera or
/// takes the recording's poses. One thread, the context's; may throw cl::Error.
/// (What is known of the next frame is found out on another.)
class FrameTracking {
 public:
  struct Setup {
    Intrinsics K;  ///< of the recording
    FusionParams params;
    bool poses_given = false;  ///< take RgbdFrame::T_world_camera
  };
  /// All outlive this. `map`: what the camera is registered to.
  [[nodiscard]] static Result<std::unique_ptr<FrameTracking>> create(ComputeContext& compute, DenseMap& map,
                                                                     StageTimer& timer, const Setup& setup);

  struct Located {
    const DepthPyramid& depth;
    PoseEstimate pose;
  };
  [[nodiscard]] Located locate(const RgbdFrame& frame);

  /// The frame after this one, if it is there already; asked for once.
  using NextFrame = std::function<std::optional<RgbdFrame>()>;
  /// Begins to locate it on another thread. Results are the same.
  void beginNext(const NextFrame& next);

  /// After the frame went into the map, which shows `surface` from its pose.
  struct Learned {
    bool is_key_frame = false;                  ///< the camera finds its way by this frame from now on
    std::optional<RevisitedKeyFrame> returned;  ///< a place that the frame before, or one before it, came
                                                ///< back to
  };
  [[nodiscard]] Learned addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth,
                                    const SurfaceMaps& surface);
  /// What of the surface the next frame is registered to. Poses are tracked.
  void follow(const SurfaceMaps& settled) { followed_ = settled; }

  /// Calls `integrate` with earlier frames whose poses were uncertain and are
  /// certain now.
  using Integrate = std::function<void(const DepthPyramid&, const Eigen::Isometry3d& T_world_camera)>;
  [[nodiscard]] std::vector<LateFrame> reconsider(const Integrate& integrate);

  /// Of the depth that frames are worked on with.
  [[nodiscard]] const Intrinsics& K() const { return K_; }
  void setK(const Intrinsics& K) { K_ = K; }
  [[nodiscard]] const DepthPyramid& prepare(const RgbdFrame& frame) { return preprocessor_->process(frame); }
  /// Null: poses are given.
  [[nodiscard]] PoseTracker* tracker() { return tracker_.get(); }
  [[nodiscard]] const SurfaceMaps& followed() const { return followed_; }
  /// No other thread is at work.
  void awaitNext();

 private:
  FrameTracking(ComputeContext& compute, StageTimer& timer) : compute_(compute), timer_(timer) {}

  ComputeContext& compute_;
  StageTimer& timer_;
  Intrinsics K_;
  std::unique_ptr<DepthPreprocessor> preprocessor_;
  std::unique_ptr<PoseTracker> tracker_;
  SurfaceMaps followed_;
  std::future<PoseTracker::TrackingAttempt> next_;  // uses what is above: goes first
};

}  // namespace scantrove
