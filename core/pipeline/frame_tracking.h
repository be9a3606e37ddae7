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

/// How the poses of a recording are used.
enum class PoseUse {
  none,       ///< the camera is tracked
  predicted,  ///< they are of a device that tracks itself, and the map refines them
  given       ///< they are the poses
};

/// The pose of each frame: prepares its depth, and tracks the camera or takes the recording's poses. One
/// thread, the context's; may throw cl::Error. (Another thread prepares the next frame.)
class FrameTracking {
 public:
  struct Setup {
    Intrinsics K;  ///< of the recording
    FusionParams params;
    PoseUse poses = PoseUse::none;  ///< of RgbdFrame::T_world_camera
    double filled_part = 1;         ///< PoseTracker::create
  };
  /// All outlive this. `map`: the camera is registered to it.
  [[nodiscard]] static Result<std::unique_ptr<FrameTracking>> create(ComputeContext& compute, DenseMap& map,
                                                                     StageTimer& timer, const Setup& setup);

  struct Located {
    const DepthPyramid& depth;
    PoseEstimate pose;
  };
  [[nodiscard]] Located locate(const RgbdFrame& frame);

  /// The next frame if it is available; called once.
  using NextFrame = std::function<std::optional<RgbdFrame>()>;
  /// Starts locating it on another thread. Results are the same.
  void beginNext(const NextFrame& next);

  /// Call after the frame was integrated; `surface` is the map rendered from its pose.
  struct KeyFrameOutcome {
    bool is_key_frame = false;                  ///< relocalisation uses this frame from now on
    std::optional<RevisitedKeyFrame> returned;  ///< the place revisited by a recent frame
  };
  [[nodiscard]] KeyFrameOutcome addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth,
                                            const SurfaceMaps& surface);
  /// The part of the surface for registering the next frame. Poses are tracked.
  void setReference(const SurfaceMaps& settled) { reference_ = settled; }

  /// Calls `integrate` with earlier frames whose uncertain poses have become certain.
  using Integrate = std::function<void(const DepthPyramid&, const Eigen::Isometry3d& T_world_camera)>;
  [[nodiscard]] std::vector<LateFrame> reconsider(const Integrate& integrate);

  /// Of the working depth of the last frame.
  [[nodiscard]] const Intrinsics& intrinsics() const { return K_; }
  /// Of that of a frame with this RgbdFrame::intrinsics.
  [[nodiscard]] Intrinsics intrinsicsOf(const std::optional<Intrinsics>& of_frame) const {
    return workingCameraOf(of_frame.value_or(setup_.K), setup_.params.working_width);
  }
  void setK(const Intrinsics& K) { K_ = K; }
  [[nodiscard]] bool isOfRecordedSize(const RgbdFrame& frame) const {
    return frame.depth.cols == setup_.K.width && frame.depth.rows == setup_.K.height;
  }
  /// Prepares the depth of a frame, which becomes the last one.
  [[nodiscard]] const DepthPyramid& prepare(const RgbdFrame& frame);
  /// Null: poses are given.
  [[nodiscard]] PoseTracker* tracker() { return tracker_.get(); }
  [[nodiscard]] const SurfaceMaps& reference() const { return reference_; }
  /// Waits until no other thread works.
  void awaitNext();

 private:
  FrameTracking(ComputeContext& compute, StageTimer& timer, const Setup& setup)
      : compute_(compute), timer_(timer), setup_(setup) {}

  /// The frame with its own intrinsics, or those of the recording.
  [[nodiscard]] RgbdFrame withIntrinsics(const RgbdFrame& frame) const;

  ComputeContext& compute_;
  StageTimer& timer_;
  Setup setup_;
  Intrinsics K_;
  std::unique_ptr<DepthPreprocessor> preprocessor_;
  std::unique_ptr<PoseTracker> tracker_;
  SurfaceMaps reference_;
  std::future<PoseTracker::TrackingAttempt> next_;  // uses the members above, so it is destroyed first
};

}  // namespace scantrove
