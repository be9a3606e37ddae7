// What colour images tell PoseTracker of the camera: landmarks, corners, and the places that it was at.
#include <algorithm>
#include <utility>

#include "core/tracking/pose_tracker.h"

namespace scantrove {
namespace {

/// Key frames that a lost camera is compared with at a time.
constexpr std::size_t kKeyFramesToTry = 3;
/// Level of the pyramid that is kept of what was seen.
constexpr std::size_t kStoredLevel = 1;

/// A key frame that shows so many is as good as the last frame.
constexpr std::size_t kManyLandmarks = 100;
/// Landmarks by which a pose may be believed, if the map agrees.
bool isWellFounded(const LandmarkPose& pose) {
  return pose.seen.pixels.size() >= 20 && pose.seen.cells() >= 5;
}

/// Corners by which a camera can be followed from one frame to the next.
constexpr std::size_t kFewestCorners = 10;
constexpr int kFewestCells = 4;  // of 48: corners in one spot tell no turn

}  // namespace

void PoseTracker::beginView(TrackingAttempt& attempt) {
  attempt.clues.gray = grayViewOf(attempt.frame, K_depth_);
  attempt.clues.last_gray = lastGray();
  attempt.clues.coming_view =
      std::async(std::launch::async, [this, before = coming_landmarks_, gray = *attempt.clues.gray] {
        if (before.valid()) before.wait();  // one finder for all
        return finder_.find(gray);
      });
}

std::future<SeenLandmarks> PoseTracker::beginCorners(const GrayView& last, const GrayView& now,
                                                     const SurfaceMaps& model,
                                                     const Eigen::Isometry3d& guess) const {
  if (last.image.empty() || now.image.empty()) return {};
  return std::async(std::launch::async, [last, now, guess, T_model = model.T_world_camera,
                                         vertices = model.vertices_world.read(compute_.queue())] {
    const SurfaceInView surface(last.K, T_model * last.T_color_depth.inverse(), vertices);
    return followCorners(last, surface, now, guess * now.T_color_depth.inverse());
  });
}

std::optional<PoseEstimate> PoseTracker::followFlow(Search& search, const Eigen::Isometry3d& guess) {
  const SeenLandmarks& seen = cornersOf(search);
  if (seen.pixels.size() < kFewestCorners || seen.cells() < kFewestCells) return std::nullopt;
  const PoseEstimate pose = judge(aligner_->align(search.depth, search.model, std::span(&guess, 1), &seen),
                                  guess, PoseOrigin::landmarks);
  return pose.usable() ? std::optional(pose) : std::nullopt;
}

std::optional<PoseEstimate> PoseTracker::followLandmarks(Search& search, const PoseEstimate& by_surface) {
  Clues& clues = search.clues;
  if (!clues.are_landmarks_sought) seekLandmarks(search, by_surface);
  if (!clues.landmarks) return std::nullopt;
  if (!clues.verified)
    clues.verified = verify(search, clues.landmarks->T_world_camera, &clues.landmarks->seen);
  return clues.verified->usable() ? clues.verified : std::nullopt;
}

void PoseTracker::seekLandmarks(Search& search, const PoseEstimate& by_surface) {
  awaitLandmarks();
  search.clues.landmarks = locateByLandmarks(search, by_surface);
  search.clues.are_landmarks_sought = true;
}

std::optional<LandmarkPose> PoseTracker::locateByLandmarks(Search& search, const PoseEstimate& by_surface) {
  const ColorView& view = viewOf(search);
  if (view.pixels.empty()) return std::nullopt;
  const auto about = by_surface.usable() ? std::optional(by_surface.T_world_camera) : std::nullopt;
  std::optional<LandmarkPose> seen;
  // A key frame rather than the last one: poses that are measured by the same landmarks do not drift.
  if (const Landmarks* near = nearestLandmarks()) seen = locate(view, *near, about);
  if (!seen || seen->seen.pixels.size() < kManyLandmarks) {
    const auto by_last = locate(view, lastLandmarks(search.model), about);
    if (by_last && (!seen || by_last->seen.pixels.size() > 2 * seen->seen.pixels.size())) seen = by_last;
  }
  if (!seen || !isWellFounded(*seen)) return std::nullopt;
  if (!is_lost_) seen->seen.append(cornersOf(search));
  return seen;
}

const Landmarks* PoseTracker::nearestLandmarks() const {
  if (adding_.valid() && adds_key_frame_) return &*last_landmarks_;
  const KeyFrame* near = key_frames_.nearest(*last_);
  return near != nullptr ? &near->landmarks : nullptr;
}

std::optional<PoseEstimate> PoseTracker::relocalize(Search& search) {
  finishAdding();
  const ColorView& view = viewOf(search);
  for (const KeyFrame* place : key_frames_.alike(thumbnailOf(search.frame), view, kKeyFramesToTry)) {
    PoseEstimate pose;
    if (view.pixels.empty()) {
      pose = verify(search, place->T_world_camera, nullptr);
    } else if (const auto seen = locate(view, place->landmarks); seen && isWellFounded(*seen)) {
      pose = verify(search, seen->T_world_camera, &seen->seen);
    }
    if (!pose.usable()) continue;
    pose.state = TrackingState::relocalized;
    return pose;
  }
  return std::nullopt;
}

bool PoseTracker::addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth, const SurfaceMaps& model) {
  finishAdding();
  last_frame_ = frame;
  K_depth_ = depth.K;
  last_gray_ = std::exchange(tracked_gray_, std::nullopt);
  last_view_ = std::exchange(tracked_view_, std::nullopt);
  last_landmarks_.reset();
  const bool is_new_key_frame = passBy(model.T_world_camera);
  if (seen_.isDue(model.T_world_camera)) {
    const DepthPyramid::Level& level = depth.levels[std::min(kStoredLevel, depth.levels.size() - 1)];
    seen_.add(model.T_world_camera, StoredSurface(level.K, level.vertices_camera.read(compute_.queue())));
  }
  if (!is_new_key_frame && !isAtUncheckedKeyFrame(model.T_world_camera)) return false;
  cv::Mat thumbnail = thumbnailOf(frame);
  if (thumbnail.empty()) return false;
  // Nobody asks for a place's features before the next frame, nor before the one after whether the camera was
  // there before: that is found out beside them.
  static_cast<void>(lastGray());
  const auto vertices =
      std::make_shared<const std::vector<cl_float4>>(model.vertices_world.read(compute_.queue()));
  const Eigen::Isometry3d& T_world_camera = model.T_world_camera;
  adds_key_frame_ = is_new_key_frame;
  coming_landmarks_ = std::async(std::launch::async, [this, T_world_camera, vertices] {
    last_landmarks_ = landmarksOf(lastView(), T_world_camera, *vertices);
  });
  adding_ = std::async(std::launch::async, [this, before = coming_landmarks_, T_world_camera, vertices,
                                            thumbnail, is_new_key_frame] {
    before.get();
    const ColorView& view = *last_view_;
    const SurfaceInView surface(view.K, T_world_camera * view.T_color_depth.inverse(), *vertices);
    AddedKeyFrame added{.key_frame = {}, .returned = returnedTo(key_frames_, thumbnail, view, surface)};
    if (is_new_key_frame) added.key_frame = KeyFrame{T_world_camera, *last_landmarks_, thumbnail};
    return added;
  });
  return is_new_key_frame;
}

bool PoseTracker::isAtUncheckedKeyFrame(const Eigen::Isometry3d& T_world_camera) {
  if (seen_.nearestSeenAgain(T_world_camera) == nullptr) return false;
  const KeyFrame* near = key_frames_.nearest(T_world_camera);
  return near != nullptr && std::exchange(asked_, near) != near;
}

void PoseTracker::finishAdding() {
  if (!adding_.valid()) return;
  coming_landmarks_ = {};
  AddedKeyFrame added = adding_.get();
  if (added.key_frame) key_frames_.add(std::move(*added.key_frame));
  if (added.returned) returned_ = added.returned;
}

void PoseTracker::awaitLandmarks() {
  if (coming_landmarks_.valid()) coming_landmarks_.get();
}

const GrayView& PoseTracker::grayOf(Search& search) {
  std::optional<GrayView>& gray = search.clues.gray;
  if (!gray) gray = grayViewOf(search.frame, search.depth.K);
  return *gray;
}

const ColorView& PoseTracker::viewOf(Search& search) {
  Clues& clues = search.clues;
  if (clues.coming_view.valid()) clues.view = clues.coming_view.get();
  if (!clues.view) clues.view = finder_.find(grayOf(search));
  return *clues.view;
}

const SeenLandmarks& PoseTracker::cornersOf(Search& search) {
  Clues& clues = search.clues;
  if (clues.coming_corners.valid()) clues.corners = clues.coming_corners.get();
  if (!clues.corners) clues.corners.emplace();
  return *clues.corners;
}

const GrayView& PoseTracker::lastGray() {
  if (!last_gray_) last_gray_ = grayViewOf(last_frame_, K_depth_);
  return *last_gray_;
}

const ColorView& PoseTracker::lastView() {
  if (!last_view_) last_view_ = finder_.find(lastGray());
  return *last_view_;
}

const Landmarks& PoseTracker::lastLandmarks(const SurfaceMaps& model) {
  if (!last_landmarks_) {
    last_landmarks_ =
        landmarksOf(lastView(), model.T_world_camera, model.vertices_world.read(compute_.queue()));
  }
  return *last_landmarks_;
}

}  // namespace scantrove
