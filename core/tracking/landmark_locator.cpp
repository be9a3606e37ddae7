#include "core/tracking/landmark_locator.h"

#include <algorithm>
#include <memory>

#include "core/tracking/tracked_corners.h"

namespace scantrove {
namespace {

/// Number of key frames that a lost camera is compared with at a time.
constexpr std::size_t kKeyFramesToTry = 3;
/// A key frame with this many matched landmarks is as good as the last frame.
constexpr std::size_t kManyLandmarks = 100;
/// Corners needed to follow a camera from one frame to the next.
constexpr std::size_t kMinCorners = 10;
constexpr int kMinCells = 4;  // of 48: corners in one spot do not determine a rotation

/// Enough landmarks for a pose that the map may confirm.
bool isWellFounded(const LandmarkPose& pose) {
  return pose.seen.pixels.size() >= 20 && pose.seen.cells() >= 5;
}

}  // namespace

void LandmarkLocator::beginView(Clues& clues) {
  clues.gray = grayViewOf(clues.frame, K_depth_);
  clues.last_gray = lastGray();
  clues.coming_view = std::async(std::launch::async, [this, before = coming_landmarks_, gray = *clues.gray] {
    if (before.valid()) before.wait();  // one finder for all
    return finder_.find(gray);
  });
}

void LandmarkLocator::beginCorners(Clues& clues, const SurfaceMaps& model, const Eigen::Isometry3d& guess) {
  const GrayView& last = clues.last_gray ? *clues.last_gray : lastGray();
  const GrayView& now = grayOf(clues);
  if (last.image.empty() || now.image.empty()) return;
  clues.coming_corners = std::async(
      std::launch::async,
      [last, now, guess, T_last = lastPose(model), vertices = model.vertices_world.read(compute_.queue())] {
        const SurfaceInView surface(last.K, T_last * last.T_color_depth.inverse(), vertices);
        return trackCorners(last, surface, now, guess * now.T_color_depth.inverse());
      });
}

const SeenLandmarks* LandmarkLocator::enoughCorners(Clues& clues) {
  const SeenLandmarks& seen = cornersOf(clues);
  const bool is_enough = seen.pixels.size() >= kMinCorners && seen.cells() >= kMinCells;
  return is_enough ? &seen : nullptr;
}

void LandmarkLocator::awaitLandmarks() {
  if (coming_landmarks_.valid()) coming_landmarks_.get();
}

void LandmarkLocator::seekLandmarks(Clues& clues, const SurfaceMaps& model,
                                    const std::optional<Eigen::Isometry3d>& about,
                                    const Eigen::Isometry3d& last, bool is_lost) {
  awaitLandmarks();
  clues.landmarks = locateByLandmarks(clues, model, about, last, is_lost);
  clues.are_landmarks_sought = true;
}

std::optional<LandmarkPose> LandmarkLocator::locateByLandmarks(Clues& clues, const SurfaceMaps& model,
                                                               const std::optional<Eigen::Isometry3d>& about,
                                                               const Eigen::Isometry3d& last, bool is_lost) {
  const ColorView& view = viewOf(clues);
  if (view.pixels.empty()) return std::nullopt;
  std::optional<LandmarkPose> seen;
  // A key frame is preferred to the last frame: poses measured by the same landmarks do not drift.
  if (const Landmarks* near = nearestLandmarks(last)) seen = locate(view, *near, about);
  if (!seen || seen->seen.pixels.size() < kManyLandmarks) {
    const auto by_last = locate(view, lastLandmarks(model), about);
    if (by_last && (!seen || by_last->seen.pixels.size() > 2 * seen->seen.pixels.size())) seen = by_last;
  }
  if (!seen || !isWellFounded(*seen)) return std::nullopt;
  if (!is_lost) seen->seen.append(cornersOf(clues));
  return seen;
}

const Landmarks* LandmarkLocator::nearestLandmarks(const Eigen::Isometry3d& T_world_camera) const {
  if (adding_.valid() && adds_key_frame_) return &*last_landmarks_;
  const KeyFrame* near = key_frames_.nearest(T_world_camera);
  return near != nullptr ? &near->landmarks : nullptr;
}

std::vector<const KeyFrame*> LandmarkLocator::similarKeyFrames(Clues& clues) {
  finishAdding();
  if (color_.isExpected() && clues.frame.color.empty()) return {};
  const ColorView& view = viewOf(clues);
  return key_frames_.alike(thumbnailOf(clues.frame), view, kKeyFramesToTry);
}

std::optional<LandmarkPose> LandmarkLocator::locateAt(Clues& clues, const KeyFrame& key_frame) {
  const ColorView& view = viewOf(clues);
  if (view.pixels.empty()) return LandmarkPose{key_frame.T_world_camera, {}};
  std::optional<LandmarkPose> found = locate(view, key_frame.landmarks);
  if (found && !isWellFounded(*found)) found.reset();
  return found;
}

void LandmarkLocator::beginFrame(const Intrinsics& K_depth) {
  K_depth_ = K_depth;
  located_gray_.reset();
  located_view_.reset();
}

void LandmarkLocator::endFrame(Clues& clues) {
  if (clues.coming_view.valid()) clues.view = clues.coming_view.get();
  located_gray_ = std::move(clues.gray);
  located_view_ = std::move(clues.view);
}

bool LandmarkLocator::setLastFrame(const RgbdFrame& frame, const Intrinsics& K_depth,
                                   const Eigen::Isometry3d& T_world_depth) {
  finishAdding();
  is_first_with_color_ = color_.add(!frame.color.empty());
  is_last_older_ = frame.color.empty() && color_.isExpected();
  if (is_last_older_) return false;
  last_frame_ = frame;
  T_world_last_ = T_world_depth;
  K_depth_ = K_depth;
  last_gray_ = std::exchange(located_gray_, std::nullopt);
  last_view_ = std::exchange(located_view_, std::nullopt);
  last_landmarks_.reset();
  return true;
}

bool LandmarkLocator::isAtUncheckedKeyFrame(const Eigen::Isometry3d& T_world_camera) {
  const KeyFrame* near = key_frames_.nearest(T_world_camera);
  return near != nullptr && std::exchange(checked_, near) != near;
}

bool LandmarkLocator::addKeyFrame(const SurfaceMaps& model, bool is_new_key_frame) {
  cv::Mat thumbnail = thumbnailOf(last_frame_);
  if (thumbnail.empty()) return false;
  // The features of a key frame are first needed by the next frame, and a loop closure by the one after it,
  // so other threads compute them meanwhile.
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

const KeyFrames& LandmarkLocator::keyFrames() {
  finishAdding();
  return key_frames_;
}

void LandmarkLocator::finishAdding() {
  if (!adding_.valid()) return;
  coming_landmarks_ = {};
  AddedKeyFrame added = adding_.get();
  if (added.key_frame) key_frames_.add(std::move(*added.key_frame));
  if (added.returned) returned_ = added.returned;
}

void LandmarkLocator::restoreState(GrayView last_gray, std::deque<KeyFrame> key_frames) {
  color_ = {};
  color_.add(!last_gray.image.empty() || std::ranges::any_of(key_frames, [](const KeyFrame& key_frame) {
    return !key_frame.landmarks.points_world.empty();
  }));
  is_first_with_color_ = is_last_older_ = false;
  last_gray_ = std::move(last_gray);
  key_frames_ = KeyFrames(std::move(key_frames));
  checked_ = nullptr;
}

void LandmarkLocator::forgetLastFrame() {
  finishAdding();
  last_frame_ = {};
  is_last_older_ = false;
  last_gray_.reset();
  last_view_.reset();
  last_landmarks_.reset();
}

const GrayView& LandmarkLocator::grayOf(Clues& clues) const {
  if (!clues.gray) clues.gray = grayViewOf(clues.frame, K_depth_);
  return *clues.gray;
}

const ColorView& LandmarkLocator::viewOf(Clues& clues) {
  if (clues.coming_view.valid()) clues.view = clues.coming_view.get();
  if (!clues.view) clues.view = finder_.find(grayOf(clues));
  return *clues.view;
}

const SeenLandmarks& LandmarkLocator::cornersOf(Clues& clues) {
  if (clues.coming_corners.valid()) clues.corners = clues.coming_corners.get();
  if (!clues.corners) clues.corners.emplace();
  return *clues.corners;
}

const GrayView& LandmarkLocator::lastGray() {
  if (!last_gray_) last_gray_ = grayViewOf(last_frame_, K_depth_);
  return *last_gray_;
}

GrayView LandmarkLocator::newestGray() { return is_last_older_ ? GrayView{} : lastGray(); }

const ColorView& LandmarkLocator::lastView() {
  if (!last_view_) last_view_ = finder_.find(lastGray());
  return *last_view_;
}

const Landmarks& LandmarkLocator::lastLandmarks(const SurfaceMaps& model) {
  if (!last_landmarks_) {
    last_landmarks_ = landmarksOf(lastView(), lastPose(model), model.vertices_world.read(compute_.queue()));
  }
  return *last_landmarks_;
}

}  // namespace scantrove
