#pragma once
#include <Eigen/Geometry>
#include <deque>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "core/capture/color_presence.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"
#include "core/tracking/color_view.h"
#include "core/tracking/key_frames.h"
#include "core/tracking/landmark_pose.h"
#include "core/tracking/revisited_key_frame.h"

namespace scantrove {

/// Locates the camera by its colour images: by landmarks of the tracking key frames and of the last usable
/// frame, and by corners of that frame. Owns the key frames and detects loop closures. If some frames have no
/// colour, the last usable frame here is the last one with colour. One thread, the
/// context's; may throw cl::Error. Other threads extract features and detect loop closures until the next
/// call that needs the result.
class LandmarkLocator {
 public:
  /// A frame and the features of its colour image that were computed so far or that other threads compute.
  struct Clues {
    RgbdFrame frame;
    std::optional<GrayView> gray = {}, last_gray = {};
    std::optional<ColorView> view = {};
    std::optional<SeenLandmarks> corners = {};  ///< corners of the last image, found in this one
    std::future<ColorView> coming_view = {};
    std::future<SeenLandmarks> coming_corners = {};
    bool are_landmarks_sought = false;
    std::optional<LandmarkPose> landmarks = {};  ///< pose by landmarks; none: they do not determine one
  };

  explicit LandmarkLocator(ComputeContext& compute) : compute_(compute) {}
  LandmarkLocator(const LandmarkLocator&) = delete;
  LandmarkLocator& operator=(const LandmarkLocator&) = delete;

  /// Starts extracting the features that locating the frame will need.
  void beginView(Clues& clues);
  /// Starts finding the corners of the last image, which sees `model`, in the image near `guess`.
  void beginCorners(Clues& clues, const SurfaceMaps& model, const Eigen::Isometry3d& guess);
  /// Those corners; null: they are too few to follow the camera.
  [[nodiscard]] static const SeenLandmarks* enoughCorners(Clues& clues);

  /// Waits for the landmarks of the last frame, which addKeyFrame() may have started.
  void awaitLandmarks();
  /// Stores the pose by landmarks of a key frame near `last`, the pose of the last usable frame, or of that
  /// frame. `about`: the pose where they are expected. A camera that is not lost uses the corners too.
  void seekLandmarks(Clues& clues, const SurfaceMaps& model, const std::optional<Eigen::Isometry3d>& about,
                     const Eigen::Isometry3d& last, bool is_lost);

  /// The key frames that a lost camera is compared with, most likely first. None for a frame without colour
  /// among others with colour, whose thumbnails cannot be compared.
  [[nodiscard]] std::vector<const KeyFrame*> similarKeyFrames(Clues& clues);
  /// Pose by landmarks of a key frame. An image without features gets the key frame's pose and no landmarks.
  [[nodiscard]] std::optional<LandmarkPose> locateAt(Clues& clues, const KeyFrame& key_frame);

  /// Call before and after locating each frame. `K_depth`: of its depth images.
  void beginFrame(const Intrinsics& K_depth);
  void endFrame(Clues& clues);
  /// Makes the frame that was located last the last usable one. False: it has no colour, and earlier ones
  /// had; the last one with colour stays, and this frame can be no key frame.
  bool setLastFrame(const RgbdFrame& frame, const Intrinsics& K_depth,
                    const Eigen::Isometry3d& T_world_depth);
  /// Whether the last usable frame is the first one with colour, so that no key frame has landmarks.
  [[nodiscard]] bool isFirstWithColor() const { return is_first_with_color_; }

  /// Whether the nearest key frame was not checked for a loop closure just before.
  [[nodiscard]] bool isAtUncheckedKeyFrame(const Eigen::Isometry3d& T_world_camera);
  /// Starts detecting a loop closure at the last usable frame, which sees `model`. Adds the frame if
  /// `is_new_key_frame`. True: it became a key frame.
  bool addKeyFrame(const SurfaceMaps& model, bool is_new_key_frame);
  /// After waiting for what addKeyFrame() started.
  [[nodiscard]] const KeyFrames& keyFrames();
  /// The key frame that the camera revisited since the last call.
  [[nodiscard]] std::optional<RevisitedKeyFrame> takeReturned() {
    return std::exchange(returned_, std::nullopt);
  }

  /// Image of the last usable frame.
  [[nodiscard]] const GrayView& lastGray();
  /// The same if no frame without colour followed it; else empty.
  [[nodiscard]] GrayView newestGray();
  void restoreState(GrayView last_gray, std::deque<KeyFrame> key_frames);
  /// Forgets the last usable frame, but no key frame.
  void forgetLastFrame();

 private:
  struct AddedKeyFrame {
    std::optional<KeyFrame> key_frame;  // none: it was not due
    std::optional<RevisitedKeyFrame> returned;
  };

  [[nodiscard]] std::optional<LandmarkPose> locateByLandmarks(Clues& clues, const SurfaceMaps& model,
                                                              const std::optional<Eigen::Isometry3d>& about,
                                                              const Eigen::Isometry3d& last, bool is_lost);
  /// Landmarks of the key frame that sees most of what a camera there sees; null: none is near.
  [[nodiscard]] const Landmarks* nearestLandmarks(const Eigen::Isometry3d& T_world_camera) const;
  /// Waits for all that addKeyFrame() started on other threads.
  void finishAdding();
  [[nodiscard]] const GrayView& grayOf(Clues& clues) const;
  [[nodiscard]] const ColorView& viewOf(Clues& clues);
  [[nodiscard]] static const SeenLandmarks& cornersOf(Clues& clues);
  /// Pose of the last usable frame; `model` is of the newest, with or without colour.
  [[nodiscard]] const Eigen::Isometry3d& lastPose(const SurfaceMaps& model) const {
    return is_last_older_ ? T_world_last_ : model.T_world_camera;
  }
  [[nodiscard]] const ColorView& lastView();
  [[nodiscard]] const Landmarks& lastLandmarks(const SurfaceMaps& model);

  ComputeContext& compute_;
  FeatureFinder finder_;
  KeyFrames key_frames_;
  RgbdFrame last_frame_;                                            // the last usable one
  Intrinsics K_depth_;                                              // of its depth images
  Eigen::Isometry3d T_world_last_ = Eigen::Isometry3d::Identity();  // its pose, if is_last_older_
  bool is_last_older_ = false;               // usable frames without colour followed it
  ColorPresence color_;                      // in usable frames
  bool is_first_with_color_ = false;         // the last usable frame
  std::optional<GrayView> last_gray_;        // its image, once needed
  std::optional<ColorView> last_view_;       // likewise
  std::optional<Landmarks> last_landmarks_;  // likewise
  std::optional<GrayView> located_gray_;     // of the frame that was located last, if it was computed
  std::optional<ColorView> located_view_;    // likewise
  const KeyFrame* checked_ = nullptr;        // the last key frame that was checked for a loop closure
  std::optional<RevisitedKeyFrame> returned_;
  bool adds_key_frame_ = false;  // whether the last usable frame is one
  // These use the members above, so they are destroyed first.
  std::shared_future<void> coming_landmarks_;  // last_view_ and last_landmarks_
  std::future<AddedKeyFrame> adding_;
};

}  // namespace scantrove
