#pragma once
#include <deque>
#include <functional>
#include <future>
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
#include "core/tracking/color_view.h"
#include "core/tracking/followed_corners.h"
#include "core/tracking/key_frames.h"
#include "core/tracking/landmark_pose.h"
#include "core/tracking/pose_estimate.h"
#include "core/tracking/revisited_key_frame.h"
#include "core/tracking/seen_surfaces.h"
#include "core/tracking/surface_aligner.h"

namespace scantrove {

/// Tracks the pose of the camera. Predicts each pose from the last motion, registers it by ICP against the
/// map's surface, and judges the result. An untrusted pose is recovered from landmarks of the last frame and
/// of the tracking key frames, so that a lost camera is found at any place that it has seen. One thread, the
/// context's; may throw cl::Error. Other threads extract the features of a new key frame and detect loop
/// closures until addKeyFrame() is called again. It is one class of more than 30 functions because all steps
/// share the state of the last frame.
class PoseTracker {
 public:
  /// Renders the map's surface from a pose.
  using ModelView = std::function<void(const Eigen::Isometry3d& T_world_camera, SurfaceMaps& surface)>;

  [[nodiscard]] static Result<std::unique_ptr<PoseTracker>> create(ComputeContext& compute,
                                                                   const FusionParams& params,
                                                                   ModelView view_model);

  /// Features of a frame's colour image that were computed so far, and those that other threads compute.
  struct Clues {
    std::optional<GrayView> gray = {}, last_gray = {};
    std::optional<ColorView> view = {};
    std::optional<SeenLandmarks> corners = {};  ///< corners of the last image, found in this one
    std::future<ColorView> coming_view = {};
    std::future<SeenLandmarks> coming_corners = {};
    bool are_landmarks_sought = false;
    std::optional<LandmarkPose> landmarks = {};  ///< pose by landmarks; none: they do not determine one
    std::optional<PoseEstimate> verified = {};   ///< that pose, registered against the map
  };
  /// The first part of tracking a frame: its pose by the surface alone and, where landmarks are likely to be
  /// needed, by landmarks.
  struct TrackingAttempt {
    RgbdFrame frame;
    PoseEstimate by_surface;
    bool is_firm = false;  ///< the surface determines the pose well
    Clues clues;
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
  [[nodiscard]] std::optional<RevisitedKeyFrame> takeReturned() {
    return std::exchange(returned_, std::nullopt);
  }

  /// The state that the next frame needs beside the map.
  struct Memory {
    Eigen::Isometry3d last = Eigen::Isometry3d::Identity();  ///< pose of the last usable frame
    std::optional<Eigen::Isometry3d> before_last;  ///< of the frame before it, if that was usable too
    bool is_lost = false;                          ///< the last frame was not usable
    GrayView last_view;                            ///< of the last usable frame
    std::deque<KeyFrame> places;
    std::deque<SeenSurfaces::View> surfaces;
  };
  /// None before the first usable frame. It leaves out uncertain frames.
  [[nodiscard]] std::optional<Memory> memory();
  /// Continues from the state of an earlier tracker of the same map. A camera elsewhere is relocalised at
  /// once.
  void restoreState(Memory memory);

  /// Continues on an earlier map, with a guess at the pose. passBy() and addKeyFrame() restore the earlier
  /// key frames, in the order of their frames.
  void resumeAt(const Eigen::Isometry3d& T_world_camera);
  /// Passes an earlier pose. True: its frame was a tracking key frame and must be given to addKeyFrame().
  [[nodiscard]] bool passBy(const Eigen::Isometry3d& T_world_camera);

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
    const RgbdFrame& frame;
    const DepthPyramid& depth;
    const SurfaceMaps& model;
    Clues& clues;
  };

  PoseTracker(ComputeContext& compute, const FusionParams& params, ModelView view_model)
      : compute_(compute), params_(params), view_model_(std::move(view_model)) {}

  [[nodiscard]] PoseEstimate begin(const DepthPyramid& depth) const;
  /// Predicted poses, best first.
  [[nodiscard]] std::vector<Eigen::Isometry3d> predict(const SurfaceMaps& model) const;
  [[nodiscard]] PoseEstimate recover(Search& search, const PoseEstimate& by_surface);
  /// Extracts the features that recover() will need.
  void beginView(TrackingAttempt& attempt);
  /// Starts what cornersOf() will need. Invalid: there is no colour.
  [[nodiscard]] std::future<SeenLandmarks> beginCorners(const GrayView& last, const GrayView& now,
                                                        const SurfaceMaps& model,
                                                        const Eigen::Isometry3d& guess) const;
  /// Pose by these corners alone, from a guess nearby.
  [[nodiscard]] std::optional<PoseEstimate> followFlow(Search& search, const Eigen::Isometry3d& guess);
  /// Pose by features of the nearest key frame or the last image.
  [[nodiscard]] std::optional<PoseEstimate> followLandmarks(Search& search, const PoseEstimate& by_surface);
  /// Stores the pose by landmarks in the clues.
  void seekLandmarks(Search& search, const PoseEstimate& by_surface);
  [[nodiscard]] std::optional<LandmarkPose> locateByLandmarks(Search& search, const PoseEstimate& by_surface);
  [[nodiscard]] std::optional<PoseEstimate> relocalize(Search& search);
  /// `guess` sees the surface of `model`.
  [[nodiscard]] bool isInView(const SurfaceMaps& model, const Eigen::Isometry3d& guess) const;
  /// Registers against the map rendered near `guess`, together with `landmarks` (may be null).
  [[nodiscard]] PoseEstimate verify(const Search& search, const Eigen::Isometry3d& guess,
                                    const SeenLandmarks* landmarks);
  /// The pose by what the camera saw at a revisited place, without the drift since.
  [[nodiscard]] PoseEstimate withoutDrift(const DepthPyramid& depth, PoseEstimate pose);
  void remember(const RgbdFrame& frame, const PoseEstimate& pose);

  [[nodiscard]] PoseEstimate judge(const IcpOutcome& outcome, const Eigen::Isometry3d& begin,
                                   PoseOrigin origin) const;
  [[nodiscard]] const GrayView& lastGray();
  /// Whether the camera is back at a key frame that was not checked yet.
  [[nodiscard]] bool isAtUncheckedKeyFrame(const Eigen::Isometry3d& T_world_camera);
  /// Waits for all that addKeyFrame() started on other threads.
  void finishAdding();
  /// Waits for the landmarks that the next frame may need.
  void awaitLandmarks();
  /// Landmarks of the key frame that sees most of what the last usable frame saw; null: none is near.
  [[nodiscard]] const Landmarks* nearestLandmarks() const;
  [[nodiscard]] static const GrayView& grayOf(Search& search);
  [[nodiscard]] const ColorView& viewOf(Search& search);
  [[nodiscard]] static const SeenLandmarks& cornersOf(Search& search);
  [[nodiscard]] const ColorView& lastView();
  [[nodiscard]] const Landmarks& lastLandmarks(const SurfaceMaps& model);

  ComputeContext& compute_;
  FusionParams params_;
  ModelView view_model_;
  std::unique_ptr<SurfaceAligner> aligner_;
  FeatureFinder finder_;
  SurfaceMaps verified_;  // the map from a verified pose

  std::optional<Eigen::Isometry3d> last_;         // pose of the last usable frame
  std::optional<Eigen::Isometry3d> before_last_;  // of the frame before it, if that was usable too
  std::optional<Eigen::Isometry3d>
      last_uncertain_;        // of the frame before, when it was neither trusted nor lost
  bool is_lost_ = false;      // the frame before was not usable
  bool was_firm_ = true;      // the surface determined its pose well
  bool is_restored_ = false;  // the next frame is the first after restoreState()

  RgbdFrame last_frame_;                     // the last usable one
  Intrinsics K_depth_;                       // of its depth images
  std::optional<GrayView> last_gray_;        // its image, once asked for
  std::optional<ColorView> last_view_;       // likewise
  std::optional<Landmarks> last_landmarks_;  // likewise
  std::optional<GrayView> tracked_gray_;     // of the frame that track() saw last, if it was asked for
  std::optional<ColorView> tracked_view_;    // likewise
  KeyFrames key_frames_;
  SeenSurfaces seen_;
  const SeenSurfaces::View* seen_again_ = nullptr;  // the one that seen_surface_ holds
  SurfaceMaps seen_surface_;
  std::deque<UncertainFrame> uncertain_;  // neither confirmed nor dropped yet
  const KeyFrame* asked_ = nullptr;       // the last key frame that was checked for a loop closure
  std::optional<RevisitedKeyFrame> returned_;
  struct AddedKeyFrame {
    std::optional<KeyFrame> key_frame;  // none: it was not due
    std::optional<RevisitedKeyFrame> returned;
  };
  bool adds_key_frame_ = false;  // whether the last usable frame is one
  std::shared_future<void>
      coming_landmarks_;               // last_view_ and last_landmarks_; uses what is above: goes first
  std::future<AddedKeyFrame> adding_;  // likewise
};

}  // namespace scantrove
