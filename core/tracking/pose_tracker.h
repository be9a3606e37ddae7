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

/// Where the camera is, frame by frame. Owns all that is known about poses. A frame's pose is predicted from
/// the motion so far, registered by ICP against the map's surface and judged; what is not trusted is
/// recovered: from landmarks of the last view and of key frames, which find the camera anywhere that it has
/// been. One thread, the context's; may throw cl::Error. (Others find the features of a new place and ask
/// whether the camera has come back to it, until learn() is called again.)
class PoseTracker {
 public:
  /// Fills the map's surface as seen from a pose.
  using ModelView = std::function<void(const Eigen::Isometry3d& T_world_camera, SurfaceMaps& surface)>;

  [[nodiscard]] static Result<std::unique_ptr<PoseTracker>> create(ComputeContext& compute,
                                                                   const FusionParams& params,
                                                                   ModelView view_model);

  /// What the colour image of a frame says, as far as it was asked, and what other threads are at.
  struct Clues {
    std::optional<GrayView> gray = {}, last_gray = {};
    std::optional<ColorView> view = {};
    std::optional<SeenLandmarks> corners = {};  ///< of the last image, found again in this one
    std::future<ColorView> coming_view = {};
    std::future<SeenLandmarks> coming_corners = {};
    bool are_landmarks_sought = false;
    std::optional<LandmarkPose> landmarks = {};  ///< where they have the camera; none: nowhere
    std::optional<PoseEstimate> verified = {};   ///< that pose, held against the map
  };
  /// What is found out of a frame first: where the surface alone has it, and, where landmarks are likely to
  /// be needed, where these have it.
  struct TrackingAttempt {
    RgbdFrame frame;
    PoseEstimate by_surface;
    bool is_firm = false;  ///< the surface determines the pose well
    Clues clues;
  };
  /// Of the frame after the one that track() and learn() were told of last.
  [[nodiscard]] TrackingAttempt beginAttempt(const RgbdFrame& frame);
  /// Looks at no more of the map than `model`, as given to learn() last: while hasUncertain() says no, this
  /// may run on another thread while this one goes on with the frame before and asks nothing of the tracker.
  void registerToModel(TrackingAttempt& attempt, const DepthPyramid& depth, const SurfaceMaps& model);
  /// The pose of that frame. `depth` and `model` as above.
  [[nodiscard]] PoseEstimate track(TrackingAttempt attempt, const DepthPyramid& depth,
                                   const SurfaceMaps& model);

  /// All of this in turn. `model`: as given to learn() last; of the first frame it is not read.
  [[nodiscard]] PoseEstimate track(const RgbdFrame& frame, const DepthPyramid& depth,
                                   const SurfaceMaps& model);
  /// The frame that was tracked last is in the map now, and `model` is the map's surface from its pose.
  /// Whether the frame became a place: one that the camera finds its way by from now on.
  bool addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth, const SurfaceMaps& model);

  /// A place that the camera was found to have come back to since the last call, by learn() of some frame
  /// before.
  [[nodiscard]] std::optional<RevisitedKeyFrame> takeReturned() {
    return std::exchange(returned_, std::nullopt);
  }

  /// What the next frame's pose is found by, beside the map.
  struct Memory {
    Eigen::Isometry3d last = Eigen::Isometry3d::Identity();  ///< pose of the last usable frame
    std::optional<Eigen::Isometry3d> before_last;  ///< of the frame before it, if that was usable too
    bool is_lost = false;                          ///< the last frame was not usable
    GrayView last_view;                            ///< of the last usable frame
    std::deque<KeyFrame> places;
    std::deque<SeenSurfaces::View> surfaces;
  };
  /// None before the first usable frame. Of frames that are uncertain it does not tell.
  [[nodiscard]] std::optional<Memory> memory();
  /// Goes on where a tracker of the same map stopped: a camera that went on, too, is followed as if nothing
  /// had been; one that is elsewhere is looked for at once.
  void restoreState(Memory memory);

  /// The camera is somewhere on a map that was made earlier, perhaps there. The places of that time are those
  /// that passBy() and learn() were told of, in the order of their frames.
  void resumeAt(const Eigen::Isometry3d& T_world_camera);
  /// A camera of that time was there. Whether its frame was a place; then learn() wants to see it.
  [[nodiscard]] bool passBy(const Eigen::Isometry3d& T_world_camera);

  /// A frame that was not trusted when it came.
  struct UncertainFrame {
    RgbdFrame frame;
    Eigen::Isometry3d T_world_camera;
    int chances;  ///< how often it may still be looked at again
  };
  [[nodiscard]] bool hasUncertain() const { return !uncertain_.empty(); }
  /// A few that may be certain by the map as it is now, the oldest first: none while the camera is lost.
  [[nodiscard]] std::vector<UncertainFrame> takeUncertain();
  /// The pose of such a frame, prepared as `depth`, by the map as it is now. One that is not usable even now
  /// is kept for as many later frames as it has chances, and then dropped.
  [[nodiscard]] PoseEstimate reconsider(UncertainFrame uncertain, const DepthPyramid& depth);

 private:
  /// The frame whose pose is looked for, and what was found out about it so far.
  struct Search {
    const RgbdFrame& frame;
    const DepthPyramid& depth;
    const SurfaceMaps& model;
    Clues& clues;
  };

  PoseTracker(ComputeContext& compute, const FusionParams& params, ModelView view_model)
      : compute_(compute), params_(params), view_model_(std::move(view_model)) {}

  [[nodiscard]] PoseEstimate begin(const DepthPyramid& depth) const;
  /// Guesses at the pose, the best first.
  [[nodiscard]] std::vector<Eigen::Isometry3d> predict(const SurfaceMaps& model) const;
  [[nodiscard]] PoseEstimate recover(Search& search, const PoseEstimate& by_surface);
  /// The colour image's features, which recover() asks for in many frames in a row.
  void beginView(TrackingAttempt& attempt);
  /// What cornersOf() is asked for soon. Not valid: there is no colour.
  [[nodiscard]] std::future<SeenLandmarks> beginCorners(const GrayView& last, const GrayView& now,
                                                        const SurfaceMaps& model,
                                                        const Eigen::Isometry3d& guess) const;
  /// By such corners alone, from a guess nearby.
  [[nodiscard]] std::optional<PoseEstimate> followFlow(Search& search, const Eigen::Isometry3d& guess);
  /// By features of the nearest key frame or the last image.
  [[nodiscard]] std::optional<PoseEstimate> followLandmarks(Search& search, const PoseEstimate& by_surface);
  /// Where these have the camera, into the clues.
  void seekLandmarks(Search& search, const PoseEstimate& by_surface);
  [[nodiscard]] std::optional<LandmarkPose> locateByLandmarks(Search& search, const PoseEstimate& by_surface);
  [[nodiscard]] std::optional<PoseEstimate> relocalize(Search& search);
  /// `guess` sees the surface of `model`.
  [[nodiscard]] bool isInView(const SurfaceMaps& model, const Eigen::Isometry3d& guess) const;
  /// Registers against the map as seen from `guess`, or near there, with the landmarks, if any, that led
  /// there.
  [[nodiscard]] PoseEstimate verify(const Search& search, const Eigen::Isometry3d& guess,
                                    const SeenLandmarks* landmarks);
  /// Where the camera has come back to: by what it saw there then, without the drift of the map since.
  [[nodiscard]] PoseEstimate withoutDrift(const DepthPyramid& depth, PoseEstimate pose);
  void remember(const RgbdFrame& frame, const PoseEstimate& pose);

  [[nodiscard]] PoseEstimate judge(const IcpOutcome& outcome, const Eigen::Isometry3d& begin,
                                   PoseOrigin origin) const;
  [[nodiscard]] const GrayView& lastGray();
  /// The camera is where it was before it was elsewhere, at a place that was not asked about yet.
  [[nodiscard]] bool isBack(const Eigen::Isometry3d& T_world_camera);
  /// What learn() left to other threads is done.
  void finishLearning();
  /// As much of it as the next frame may ask for.
  void awaitLandmarks();
  /// Of the key frame that sees most like the last usable frame, or null: none is near.
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
  SurfaceMaps verified_;  // the map from where a pose was verified

  std::optional<Eigen::Isometry3d> last_;         // pose of the last usable frame
  std::optional<Eigen::Isometry3d> before_last_;  // of the frame before it, if that was usable too
  std::optional<Eigen::Isometry3d>
      last_uncertain_;        // of the frame before, when it was neither trusted nor lost
  bool is_lost_ = false;      // the frame before was not usable
  bool was_firm_ = true;      // the surface determined its pose well
  bool has_gone_on_ = false;  // the next frame is the first after restoreState()

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
  const KeyFrame* asked_ = nullptr;       // the place that was last asked whether the camera is back at it
  std::optional<RevisitedKeyFrame> returned_;
  struct AddedKeyFrame {
    std::optional<KeyFrame> place;  // a new one
    std::optional<RevisitedKeyFrame> returned;
  };
  bool adds_key_frame_ = false;  // it is that of the last usable frame
  std::shared_future<void>
      coming_landmarks_;                 // last_view_ and last_landmarks_; uses what is above: goes first
  std::future<AddedKeyFrame> learning_;  // likewise
};

}  // namespace scantrove
