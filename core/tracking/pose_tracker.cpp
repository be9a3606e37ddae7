#include "core/tracking/pose_tracker.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "core/tracking/motion_prediction.h"
#include "core/tracking/view_distance.h"

namespace scantrove {
namespace {

/// Share of pixels with depth that the first frame of a map needs.
constexpr double kMinDepthToBegin = 0.05;
/// The first frame of a map waits for so many frames until the device knows its own pose; then the map begins
/// without.
constexpr int kFramesToAwaitDevice = 30;
/// Share of pixels with depth that a frame needs to be added to the map without the map's consent.
constexpr double kMinDepthToFollow = 0.02;
/// Share of inliers above which an uncertain pose is a guess for the next frame.
constexpr double kWorthTracking = 0.4;
/// Level of the pyramid that is stored of a seen surface.
constexpr std::size_t kStoredLevel = 1;
/// Limits for uncertain frames: how many are kept (the newest), how many are tried again with each usable
/// frame, and how often each is tried.
constexpr std::size_t kMaxUncertain = 10;
constexpr std::ptrdiff_t kUncertainAtATime = 2;
constexpr int kChances = 10;

/// Views within this distance show the same surface.
constexpr ViewReach kSameView{.angle_rad = 0.06, .distance_m = 0.06};
/// A camera that continues farther than this from its restored pose must be relocalised like a lost one.
constexpr ViewReach kElsewhere{.angle_rad = 0.5, .distance_m = 0.3};

}  // namespace

Result<std::unique_ptr<PoseTracker>> PoseTracker::create(ComputeContext& compute, const FusionParams& params,
                                                         ModelView view_model, Predictor predictor,
                                                         double filled_part) {
  std::unique_ptr<PoseTracker> tracker(new PoseTracker(compute, params, std::move(view_model), predictor));
  tracker->filled_part_ = filled_part;
  SCANTROVE_TRY(moveInto(tracker->aligner_, SurfaceAligner::create(compute, params.depth_noise_m)));
  return tracker;
}

PoseEstimate PoseTracker::track(const RgbdFrame& frame, const DepthPyramid& depth, const SurfaceMaps& model) {
  TrackingAttempt attempt = beginAttempt(frame);
  registerToModel(attempt, depth, model);
  return track(std::move(attempt), depth, model);
}

PoseTracker::TrackingAttempt PoseTracker::beginAttempt(const RgbdFrame& frame) {
  TrackingAttempt attempt{.clues = {.frame = frame}};
  if (last_ && !was_firm_) locator_.beginView(attempt.clues);
  if (last_ && device_ && frame.T_world_camera)
    attempt.by_device = device_->predict(*frame.T_world_camera, frame.timestamp_s);
  // A recording that goes on elsewhere tells nothing about the way there.
  if (is_restored_ && attempt.by_device && attempt.by_device->T_world_jumped) attempt.by_device.reset();
  return attempt;
}

void PoseTracker::registerToModel(TrackingAttempt& attempt, const DepthPyramid& depth,
                                  const SurfaceMaps& model) {
  if (!last_) return;
  if (attempt.by_device) {
    if (viewDistance(model.T_world_camera, attempt.by_device->T_world_camera, kSameView) < 1)
      registerNearDevice(attempt, depth, model, attempt.by_device->T_world_camera);
    return;
  }
  const std::vector<Eigen::Isometry3d> guesses = predict(model);
  const IcpOutcome outcome = aligner_->align(depth, model, guesses);
  attempt.by_surface = judge(outcome, model.T_world_camera, GuessOrigin::prediction);
  attempt.is_firm = outcome.step.is_firm;
  if (attempt.by_surface.state == TrackingState::lost) attempt.by_surface.T_world_camera = guesses.front();
  const bool is_enough = attempt.by_surface.usable() && attempt.is_firm;
  LandmarkLocator::Clues& clues = attempt.clues;
  if (is_enough || is_lost_ || is_restored_ || !clues.gray) return;
  locator_.beginCorners(clues, model, attempt.by_surface.T_world_camera);
  Search search{attempt, depth, model};
  seekLandmarks(search);
  if (clues.landmarks && isInView(model, clues.landmarks->T_world_camera))
    attempt.by_landmarks = verify(search, clues.landmarks->T_world_camera, &clues.landmarks->seen);
}

void PoseTracker::registerNearDevice(TrackingAttempt& attempt, const DepthPyramid& depth,
                                     const SurfaceMaps& model, const Eigen::Isometry3d& guess) {
  // After a jump the device determines no direction.
  const bool has_jumped = attempt.by_device->T_world_jumped.has_value();
  const std::span guesses(&guess, 1);
  const IcpOutcome outcome =
      has_jumped ? aligner_->align(depth, model, guesses) : aligner_->alignFirmly(depth, model, guesses);
  attempt.by_surface = judge(outcome, guess, has_jumped ? GuessOrigin::prediction : GuessOrigin::device);
  attempt.is_firm = outcome.step.is_firm;
  attempt.is_registered = true;
  if (outcome.pixels > 0) attempt.readings = outcome.system.readings / static_cast<double>(outcome.pixels);
  if (attempt.by_surface.state == TrackingState::lost) attempt.by_surface.T_world_camera = guess;
}

PoseEstimate PoseTracker::track(TrackingAttempt attempt, const DepthPyramid& depth,
                                const SurfaceMaps& model) {
  locator_.beginFrame(depth.K);
  PoseEstimate pose;
  if (!last_) {
    pose = begin(attempt.clues.frame, depth);
  } else {
    Search search{attempt, depth, model};
    pose = attempt.by_surface;
    if (attempt.by_device) {
      pose = trackByDevice(search);
    } else {
      if (!pose.usable() || !attempt.is_firm) pose = recover(search);
      was_firm_ = attempt.is_firm;
    }
    if (pose.usable()) pose = withoutDrift(depth, pose);
    locator_.endFrame(attempt.clues);
  }
  remember(attempt, pose);
  return pose;
}

PoseEstimate PoseTracker::trackByDevice(Search& search) {
  TrackingAttempt& attempt = search.attempt;
  const DeviceMotion::Prediction& device = *attempt.by_device;
  const auto registerAt = [&](const Eigen::Isometry3d& guess) {
    view_model_(guess, verified_);
    registerNearDevice(attempt, search.depth, verified_, guess);
  };
  if (!attempt.is_registered) registerAt(device.T_world_camera);
  // It may have been no jump but a jerk of the hand.
  if (!attempt.by_surface.usable() && device.T_world_jumped) {
    const PoseEstimate without_jump = attempt.by_surface;
    registerAt(*device.T_world_jumped);
    if (!attempt.by_surface.usable()) attempt.by_surface = without_jump;
  }
  PoseEstimate pose = attempt.by_surface;
  was_firm_ = pose.usable() && device.agrees(pose.T_world_camera, attempt.is_firm);
  if (!was_firm_) {
    if (pose.usable()) attempt.by_surface.state = TrackingState::uncertain;
    pose = recover(search);
    if (pose.usable() && !device.agrees(pose.T_world_camera, true)) pose.state = TrackingState::uncertain;
    if (!pose.usable() && !device.T_world_jumped && attempt.readings >= kMinDepthToFollow) {
      pose = attempt.by_surface;
      pose.state = TrackingState::tracking;
      pose.T_world_camera = device.T_world_camera;
      pose.is_by_device = true;
    }
  }
  pose.has_device_jumped = device.T_world_jumped.has_value();
  return pose;
}

PoseEstimate PoseTracker::begin(const RgbdFrame& frame, const DepthPyramid& depth) {
  if (device_ && !frame.T_world_camera && ++frames_without_device_ <= kFramesToAwaitDevice) return {};
  const int pixels = depth.levels.front().K.pixels();
  std::vector<cl_float4> vertices(static_cast<std::size_t>(pixels));
  depth.levels.front().vertices_camera.read(compute_.queue(), std::span(vertices));
  const auto readings = std::ranges::count_if(vertices, [](const cl_float4& v) { return v.s[3] > 0; });
  PoseEstimate pose;
  if (static_cast<double>(readings) >= kMinDepthToBegin * filled_part_ * pixels) {
    pose.state = TrackingState::tracking;
    pose.inlier_fraction = 1;
    if (device_ && frame.T_world_camera) pose.T_world_camera = *frame.T_world_camera;
  }
  return pose;
}

std::vector<Eigen::Isometry3d> PoseTracker::predict(const SurfaceMaps& model) const {
  std::vector<Eigen::Isometry3d> guesses{before_last_ ? predictPose(*last_, *before_last_) : *last_};
  guesses.push_back(model.T_world_camera);                   // a camera that stopped
  if (last_uncertain_) guesses.push_back(*last_uncertain_);  // a camera on its way back
  return guesses;
}

PoseEstimate PoseTracker::judge(const IcpOutcome& outcome, const Eigen::Isometry3d& begin,
                                GuessOrigin origin) const {
  IcpOutcome filled = outcome;
  filled.pixels = static_cast<int>(filled_part_ * outcome.pixels);
  return judgePose(filled, begin, origin, static_cast<double>(params_.depth_noise_m));
}

PoseEstimate PoseTracker::recover(Search& search) {
  locator_.awaitLandmarks();
  LandmarkLocator::Clues& clues = search.attempt.clues;
  const PoseEstimate& by_surface = search.attempt.by_surface;
  if (!is_lost_ && !clues.corners && !clues.coming_corners.valid())
    locator_.beginCorners(clues, search.model, by_surface.T_world_camera);
  const auto by_landmarks = trackLandmarks(search);
  if (by_landmarks && !(is_restored_ && viewDistance(*last_, by_landmarks->T_world_camera, kElsewhere) > 1)) {
    PoseEstimate found = *by_landmarks;
    if (is_lost_) found.state = TrackingState::relocalized;
    return found;
  }
  if (!is_lost_) {
    if (const auto found = trackFlow(search)) return *found;
  }
  if (by_surface.usable()) return by_surface;
  if (by_surface.free_directions == 0) {
    PoseEstimate found = judge(aligner_->alignTurned(search.depth, search.model), search.model.T_world_camera,
                               GuessOrigin::search);
    if (found.usable()) return found;
  }
  is_lost_ = is_lost_ || is_restored_;
  if (is_lost_) {
    if (const auto found = relocalize(search)) return *found;
  }
  return by_surface;
}

void PoseTracker::seekLandmarks(Search& search) {
  const PoseEstimate& by_surface = search.attempt.by_surface;
  const auto about = by_surface.usable() ? std::optional(by_surface.T_world_camera) : std::nullopt;
  locator_.seekLandmarks(search.attempt.clues, search.model, about, *last_, is_lost_);
}

std::optional<PoseEstimate> PoseTracker::trackLandmarks(Search& search) {
  const LandmarkLocator::Clues& clues = search.attempt.clues;
  if (!clues.are_landmarks_sought) seekLandmarks(search);
  if (!clues.landmarks) return std::nullopt;
  std::optional<PoseEstimate>& pose = search.attempt.by_landmarks;
  if (!pose) pose = verify(search, clues.landmarks->T_world_camera, &clues.landmarks->seen);
  return pose->usable() ? pose : std::nullopt;
}

std::optional<PoseEstimate> PoseTracker::trackFlow(Search& search) {
  const SeenLandmarks* corners = LandmarkLocator::enoughCorners(search.attempt.clues);
  if (corners == nullptr) return std::nullopt;
  const Eigen::Isometry3d& guess = search.attempt.by_surface.T_world_camera;
  const PoseEstimate pose = judge(aligner_->align(search.depth, search.model, std::span(&guess, 1), corners),
                                  guess, GuessOrigin::landmarks);
  return pose.usable() ? std::optional(pose) : std::nullopt;
}

std::optional<PoseEstimate> PoseTracker::relocalize(Search& search) {
  LandmarkLocator::Clues& clues = search.attempt.clues;
  for (const KeyFrame* place : locator_.similarKeyFrames(clues)) {
    const std::optional<LandmarkPose> found = locator_.locateAt(clues, *place);
    if (!found) continue;
    PoseEstimate pose =
        verify(search, found->T_world_camera, found->seen.pixels.empty() ? nullptr : &found->seen);
    if (!pose.usable()) continue;
    pose.state = TrackingState::relocalized;
    return pose;
  }
  return std::nullopt;
}

bool PoseTracker::isInView(const SurfaceMaps& model, const Eigen::Isometry3d& guess) const {
  return !is_lost_ && viewDistance(model.T_world_camera, guess, kSameView) < 1;
}

PoseEstimate PoseTracker::verify(const Search& search, const Eigen::Isometry3d& guess,
                                 const SeenLandmarks* landmarks) {
  const bool is_in_view = isInView(search.model, guess);
  if (!is_in_view) view_model_(guess, verified_);
  const GuessOrigin origin = landmarks == nullptr ? GuessOrigin::search
                             : is_lost_           ? GuessOrigin::key_frame
                                                  : GuessOrigin::landmarks;
  return judge(
      aligner_->align(search.depth, is_in_view ? search.model : verified_, std::span(&guess, 1), landmarks),
      guess, origin);
}

PoseEstimate PoseTracker::withoutDrift(const DepthPyramid& depth, PoseEstimate pose) {
  const SeenSurfaces::View* seen = seen_.nearestSeenAgain(pose.T_world_camera);
  if (seen == nullptr) return pose;
  if (seen != seen_again_) writeView(compute_, seen->surface.render(seen->T_world_camera), seen_surface_);
  seen_again_ = seen;
  const IcpOutcome outcome = aligner_->align(depth, seen_surface_, std::span(&pose.T_world_camera, 1));
  if (!isSeenAgain(outcome, pose.T_world_camera)) return pose;
  pose.drift_m = (outcome.T_world_camera.translation() - pose.T_world_camera.translation()).norm();
  pose.T_world_camera = outcome.T_world_camera;
  pose.is_by_device = false;
  return pose;
}

void PoseTracker::remember(const TrackingAttempt& attempt, const PoseEstimate& pose) {
  if (device_ && attempt.clues.frame.T_world_camera) followDevice(attempt, pose);
  before_last_ = pose.usable() && !is_lost_ ? last_ : std::nullopt;
  if (pose.usable()) last_ = pose.T_world_camera;
  is_lost_ = !pose.usable();
  is_restored_ = false;
  last_uncertain_.reset();
  if (pose.state == TrackingState::uncertain && pose.inlier_fraction >= kWorthTracking)
    last_uncertain_ = pose.T_world_camera;
  if (!last_uncertain_) return;
  uncertain_.push_back({attempt.clues.frame, pose.T_world_camera, kChances});
  if (uncertain_.size() > kMaxUncertain) uncertain_.pop_front();
}

void PoseTracker::followDevice(const TrackingAttempt& attempt, const PoseEstimate& pose) {
  const RgbdFrame& frame = attempt.clues.frame;
  // A lost camera that the device does not follow either is found by relocalisation.
  if (!pose.usable() && !attempt.by_device) return device_->forget();
  using enum DeviceMotion::Support;
  const bool is_confirmed = pose.usable() && !pose.is_by_device;
  // A recovered pose agrees with landmarks, or with surface that determines it.
  const bool is_recovered = attempt.by_device && !was_firm_;
  const bool is_firm = !attempt.by_device || attempt.is_firm || is_recovered || pose.drift_m.has_value();
  device_->update(*frame.T_world_camera, frame.timestamp_s,
                  pose.usable() ? pose.T_world_camera : attempt.by_device->T_world_camera,
                  !is_confirmed ? none
                  : is_firm     ? firm
                                : partial);
}

std::vector<PoseTracker::UncertainFrame> PoseTracker::takeUncertain() {
  if (is_lost_) return {};
  const auto last = uncertain_.begin() + std::min<std::ptrdiff_t>(std::ssize(uncertain_), kUncertainAtATime);
  std::vector<UncertainFrame> taken(std::make_move_iterator(uncertain_.begin()),
                                    std::make_move_iterator(last));
  uncertain_.erase(uncertain_.begin(), last);
  return taken;
}

PoseEstimate PoseTracker::reconsider(UncertainFrame uncertain, const DepthPyramid& depth) {
  const Eigen::Isometry3d guess = uncertain.T_world_camera;
  view_model_(guess, verified_);
  PoseEstimate pose =
      judge(aligner_->align(depth, verified_, std::span(&guess, 1)), guess, GuessOrigin::prediction);
  if (!pose.usable() && --uncertain.chances > 0) uncertain_.push_back(std::move(uncertain));
  return pose;
}

bool PoseTracker::addKeyFrame(const RgbdFrame& frame, const DepthPyramid& depth, const SurfaceMaps& model) {
  const Eigen::Isometry3d& T_world_camera = model.T_world_camera;
  const bool has_landmarks = locator_.setLastFrame(frame, depth.K, T_world_camera);
  const bool is_new_key_frame = replayPose(T_world_camera) || locator_.isFirstWithColor();
  if (seen_.isDue(T_world_camera)) {
    const DepthPyramid::Level& level = depth.levels[std::min(kStoredLevel, depth.levels.size() - 1)];
    seen_.add(T_world_camera, StoredSurface(level.K, level.vertices_camera.read(compute_.queue())));
  }
  const auto mayCloseLoop = [&] {
    return seen_.nearestSeenAgain(T_world_camera) != nullptr &&
           locator_.isAtUncheckedKeyFrame(T_world_camera);
  };
  if (!has_landmarks || (!is_new_key_frame && !mayCloseLoop())) return false;
  return locator_.addKeyFrame(model, is_new_key_frame);
}

bool PoseTracker::replayPose(const Eigen::Isometry3d& T_world_camera) {
  const KeyFrames& key_frames = locator_.keyFrames();
  seen_.markRevisitable(T_world_camera);
  return key_frames.isDue(T_world_camera);
}

std::optional<PoseTracker::Memory> PoseTracker::memory() {
  const KeyFrames& key_frames = locator_.keyFrames();
  if (!last_) return std::nullopt;
  return Memory{*last_,
                before_last_,
                is_lost_,
                locator_.newestGray(),
                key_frames.all(),
                seen_.all(),
                device_ ? device_->memory() : std::nullopt};
}

void PoseTracker::restoreState(Memory memory) {
  relocalizeNear(memory.last);
  before_last_ = memory.before_last;
  is_lost_ = memory.is_lost;
  is_restored_ = true;
  if (device_ && memory.device) device_->restore(*memory.device);
  locator_.restoreState(std::move(memory.last_view), std::move(memory.places));
  seen_ = SeenSurfaces(std::move(memory.surfaces));
  seen_again_ = nullptr;
}

void PoseTracker::relocalizeNear(const Eigen::Isometry3d& T_world_camera) {
  // The last usable frame was seen from elsewhere, so it does not show the surface in view there.
  locator_.forgetLastFrame();
  last_ = T_world_camera;
  is_lost_ = true;
  forgetDevice();
}

}  // namespace scantrove
