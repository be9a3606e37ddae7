#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/surface_maps.h"
#include "core/tracking/device_motion.h"
#include "core/tracking/key_frames.h"
#include "core/tracking/landmark_locator.h"
#include "core/tracking/pose_estimate.h"
#include "core/tracking/revisited_key_frame.h"
#include "core/tracking/seen_surfaces.h"
#include "core/tracking/surface_aligner.h"

namespace scantrove {

/// Tracks the pose of the camera. Predicts each pose from the last motion, registers it by ICP against the
/// map's surface, and judges the result. An untrusted pose is recovered by landmarks of the last frame and of
/// the tracking key frames (LandmarkLocator), so that a lost camera is found at any place that it has seen.
///
/// With a device that tracks itself, its motion is the prediction (DeviceMotion). The map refines it, and
/// where the map refuses or contradicts it beyond its noise, the pose is the device's.
///
/// One thread, the context's; may throw cl::Error. Other threads extract the features of a new key frame and
/// detect loop closures until addKeyFrame() is called again.
class PoseTracker {
 public:
  /// Renders the map's surface from a pose.
  using ModelView = std::function<void(const Eigen::Isometry3d& T_world_camera, SurfaceMaps& surface)>;
  /// What predicts a pose.
  enum class Predictor {
    camera,  ///< the camera's motion in the map
    device   ///< RgbdFrame::T_world_camera, of a device that tracks itself; the map begins in its world
  };

  /// `filled_part`: of the images, that the surface may fill at least. 1 for a room; a single object fills
  /// less, and the limits for known surface in view are parts of this.
  [[nodiscard]] static Result<std::unique_ptr<PoseTracker>> create(ComputeContext& compute,
                                                                   const FusionParams& params,
                                                                   ModelView view_model,
                                                                   Predictor predictor = Predictor::camera,
                                                                   double filled_part = 1);

  /// The first part of tracking a frame: its pose by the surface alone and, where landmarks are likely to be
  /// needed, by landmarks.
  struct TrackingAttempt {
    LandmarkLocator::Clues clues;
    PoseEstimate by_surface = {};
    bool is_firm = false;                           ///< the surface determines the pose well
    std::optional<PoseEstimate> by_landmarks = {};  ///< pose by landmarks, registered against the map
    std::optional<DeviceMotion::Prediction> by_device = {};
    // With by_device:
    bool is_registered = false;  ///< by_surface is known; else track() has to view the map first
    double readings = 0;         ///< part of the pixels with depth
  };
  /// Begins with the frame after the last one of track() and addKeyFrame().
  [[nodiscard]] TrackingAttempt beginAttempt(const RgbdFrame& frame);
  /// Reads only `model` of the map, as given to the last addKeyFrame(). While hasUncertain() is false, it may
  /// run on another thread; the caller must not use the tracker meanwhile.
  void registerToModel(TrackingAttempt& attempt, const DepthPyramid& depth, const SurfaceMaps& model);
  /// Completes an attempt. `depth` and `model` as above.
  [[nodiscard]] PoseEstimate track(TrackingAttempt attempt, const DepthPyramid& depth,
                                   const SurfaceMaps& model);

  /// All steps in turn. `model`: as given to the last addKeyFrame(); the first frame does not read it.
  [[nodiscard]] PoseEstimate track(const RgbdFrame& frame, const DepthPyramid& depth,
                                   const SurfaceMaps& model);
  /// Call after the last tracked frame was integrated; `model` is the map's surface from its pose. True: the
  /// frame became a tracking key frame.
  bool addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth, const SurfaceMaps& model);

  /// The key frame that the camera revisited since the last call, detected by an earlier addKeyFrame().
  [[nodiscard]] std::optional<RevisitedKeyFrame> takeReturned() { return locator_.takeReturned(); }

  /// The state that the next frame needs beside the map.
  struct Memory {
    Eigen::Isometry3d last = Eigen::Isometry3d::Identity();  ///< pose of the last usable frame
    std::optional<Eigen::Isometry3d> before_last;  ///< of the frame before it, if that was usable too
    bool is_lost = false;                          ///< the last frame was not usable
    GrayView last_view;                            ///< of the last usable frame; empty without colour
    std::deque<KeyFrame> places;
    std::deque<SeenSurfaces::View> surfaces;
    std::optional<DeviceMotion::Memory> device = {};
  };
  /// None before the first usable frame. It leaves out uncertain frames.
  [[nodiscard]] std::optional<Memory> memory();
  /// Continues from the state of an earlier tracker of the same map. A camera elsewhere is relocalised at
  /// once.
  void restoreState(Memory memory);
  /// The device's poses are of another recording than those before, so they have another world.
  void forgetDevice() {
    if (device_) device_->forget();
  }

  /// Frames are missing before the next one, and the device may have begun a new world. A camera elsewhere is
  /// relocalised at once.
  void interrupt() {
    is_restored_ = last_.has_value();
    forgetDevice();
  }

  /// Continues on an earlier map, with a guess at the pose. replayPose() and addKeyFrame() restore the
  /// earlier key frames, in the order of their frames.
  void relocalizeNear(const Eigen::Isometry3d& T_world_camera);
  /// Passes an earlier pose. True: its frame was a tracking key frame and must be given to addKeyFrame().
  [[nodiscard]] bool replayPose(const Eigen::Isometry3d& T_world_camera);

  /// A frame whose pose was not trusted at first.
  struct UncertainFrame {
    RgbdFrame frame;
    Eigen::Isometry3d T_world_camera;
    int chances;  ///< how often it may still be tried
  };
  [[nodiscard]] bool hasUncertain() const { return !uncertain_.empty(); }
  /// A few uncertain frames to try again with the present map, oldest first; none while the camera is lost.
  [[nodiscard]] std::vector<UncertainFrame> takeUncertain();
  /// Tracks an uncertain frame, prepared as `depth`, with the present map. A frame that stays unusable is
  /// dropped when its chances are used up.
  [[nodiscard]] PoseEstimate reconsider(UncertainFrame uncertain, const DepthPyramid& depth);

 private:
  /// A frame and what is known of its pose so far.
  struct Search {
    TrackingAttempt& attempt;
    const DepthPyramid& depth;
    const SurfaceMaps& model;
  };

  PoseTracker(ComputeContext& compute, const FusionParams& params, ModelView view_model, Predictor predictor)
      : compute_(compute), params_(params), view_model_(std::move(view_model)), locator_(compute) {
    if (predictor == Predictor::device) device_.emplace();
  }

  [[nodiscard]] PoseEstimate begin(const RgbdFrame& frame, const DepthPyramid& depth);
  /// Predicted poses, best first.
  [[nodiscard]] std::vector<Eigen::Isometry3d> predict(const SurfaceMaps& model) const;
  /// The pose by the map, if it agrees with the device's motion, else by that motion.
  [[nodiscard]] PoseEstimate trackByDevice(Search& search);
  /// Registers against `model`, the map as seen from about `guess`, which is a pose by the device.
  void registerNearDevice(TrackingAttempt& attempt, const DepthPyramid& depth, const SurfaceMaps& model,
                          const Eigen::Isometry3d& guess);
  [[nodiscard]] PoseEstimate recover(Search& search);
  void seekLandmarks(Search& search);
  /// Pose by the corners of the last image alone, from the pose by the surface.
  [[nodiscard]] std::optional<PoseEstimate> trackFlow(Search& search);
  /// Pose by features of the nearest key frame or the last image.
  [[nodiscard]] std::optional<PoseEstimate> trackLandmarks(Search& search);
  [[nodiscard]] std::optional<PoseEstimate> relocalize(Search& search);
  /// `guess` sees the surface of `model`.
  [[nodiscard]] bool isInView(const SurfaceMaps& model, const Eigen::Isometry3d& guess) const;
  /// Registers against the map rendered near `guess`, together with `landmarks` (may be null).
  [[nodiscard]] PoseEstimate verify(const Search& search, const Eigen::Isometry3d& guess,
                                    const SeenLandmarks* landmarks);
  /// The pose by what the camera saw at a revisited place, without the drift since.
  [[nodiscard]] PoseEstimate withoutDrift(const DepthPyramid& depth, PoseEstimate pose);
  void remember(const TrackingAttempt& attempt, const PoseEstimate& pose);
  void followDevice(const TrackingAttempt& attempt, const PoseEstimate& pose);

  [[nodiscard]] PoseEstimate judge(const IcpOutcome& outcome, const Eigen::Isometry3d& begin,
                                   GuessOrigin origin) const;

  ComputeContext& compute_;
  FusionParams params_;
  double filled_part_ = 1;
  ModelView view_model_;
  std::unique_ptr<SurfaceAligner> aligner_;
  SurfaceMaps verified_;  // the map rendered near the last verified pose

  std::optional<Eigen::Isometry3d> last_;            // pose of the last usable frame
  std::optional<Eigen::Isometry3d> before_last_;     // of the frame before it, if that was usable too
  std::optional<Eigen::Isometry3d> last_uncertain_;  // of the frame before, if neither trusted nor lost
  bool is_lost_ = false;                             // the frame before was not usable
  bool was_firm_ = true;                             // the surface determined its pose well
  bool is_restored_ = false;            // the next frame is the first after restoreState() or interrupt()
  std::optional<DeviceMotion> device_;  // none: the camera's own motion is the prediction
  int frames_without_device_ = 0;       // before the first frame of the map

  SeenSurfaces seen_;
  const SeenSurfaces::View* seen_again_ = nullptr;  // the view rendered in seen_surface_
  SurfaceMaps seen_surface_;
  std::deque<UncertainFrame> uncertain_;  // neither confirmed nor dropped yet
  LandmarkLocator locator_;
};

}  // namespace scantrove
