#include "core/tracking/pose_judgment.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

// Below these a pose is lost.
constexpr double kLostInlierFraction = 0.10;
constexpr double kLostOverlap = 0.02;  // pixels that meet the model / pixels of the image
// Above this it may be trusted.
constexpr double kTrustedOverlap = 0.06;
// Pixels that meet the model / pixels with depth, below which little of the view is known.
constexpr double kMuchIsKnown = 0.20;
// A wrong pose has readings in front of and behind the surface. Each reading behind makes this many in front
// count against the pose.
constexpr double kBeforePerBehind = 2;
// A trusted pose has converged and is within a hand's reach of the last one.
constexpr double kRest_rad = 0.001;
constexpr double kRest_m = 0.002;
constexpr double kReach_rad = 0.5;
constexpr double kReach_m = 0.3;

/// Evidence that a trusted pose needs. Residuals are in units of the camera's noise. On recordings of
/// structured-light cameras correct poses left 2 to 5.3, with 0.7 to 0.95 inliers even over far motions;
/// wrong ones left 4 to 13, with 0.75 inliers at most. After a small motion a wrong pose is unlikely, and
/// half-seen surfaces are common. The likelier a false minimum is, the more evidence is needed.
struct Evidence {
  double inlier_fraction;
  double residual;  ///< IcpSystem::fit_residual_m / FusionParams::depth_noise_m
};
// Little of the map in view, or a recognised key frame, needs as much as a far motion. Landmarks that agree
// replace much of the surface.
constexpr Evidence kAfterSmallMotion{.inlier_fraction = 0.50, .residual = 7.6};
constexpr Evidence kAfterFarMotion{.inlier_fraction = 0.70, .residual = 6.0};
constexpr Evidence kAfterSearch{.inlier_fraction = 0.78, .residual = 4.6};
constexpr Evidence kOnLittle{.inlier_fraction = 0.70, .residual = 6.0};
constexpr Evidence kAtLandmarks{.inlier_fraction = 0.40, .residual = 20};
constexpr Evidence kAtKeyFrame{.inlier_fraction = 0.70, .residual = 6.0};
// Largest landmark error of a pose that agrees with its landmarks.
constexpr double kLandmarksAgree_px = 3;
constexpr double kFar_rad = 0.07;  // far motions in one frame begin here
constexpr double kFar_m = 0.08;

const Evidence& requiredEvidence(GuessOrigin origin, bool on_little, double angle_rad, double distance_m) {
  if (origin == GuessOrigin::search) return kAfterSearch;
  if (origin == GuessOrigin::landmarks) return kAtLandmarks;
  if (origin == GuessOrigin::key_frame) return kAtKeyFrame;
  if (on_little) return kOnLittle;
  return angle_rad > kFar_rad || distance_m > kFar_m ? kAfterFarMotion : kAfterSmallMotion;
}

/// Pixels that meet known surface, without those that may show something new.
double overlapOf(const IcpSystem& system, GuessOrigin origin) {
  if (origin == GuessOrigin::search || origin == GuessOrigin::key_frame) return system.overlap;
  return system.overlap - std::max(0.0, system.before - kBeforePerBehind * system.behind);
}

// For isSeenAgain().
constexpr double kSeenAgain = 0.5;      // part of the readings that meets the stored surface
constexpr double kFitsAgain = 0.75;     // part of these that fits
constexpr double kMaxDrift_rad = 0.05;  // of a map, over a loop in a room
constexpr double kMaxDrift_m = 0.10;

bool isAtRest(const IcpStep& step) { return step.rotation_rad < kRest_rad && step.translation_m < kRest_m; }

}  // namespace

bool isSeenAgain(const IcpOutcome& outcome, const Eigen::Isometry3d& by_map) {
  const IcpSystem& system = outcome.system;
  const Eigen::Isometry3d drift = by_map.inverse() * outcome.T_world_camera;
  return outcome.step.finite && outcome.step.is_firm && isAtRest(outcome.step) &&
         system.overlap >= kSeenAgain * system.readings && system.inliers >= kFitsAgain * system.overlap &&
         Eigen::AngleAxisd(drift.linear()).angle() < kMaxDrift_rad &&
         drift.translation().norm() < kMaxDrift_m;
}

PoseEstimate judgePose(const IcpOutcome& outcome, const Eigen::Isometry3d& begin, GuessOrigin origin,
                       double depth_noise_m) {
  const IcpSystem& system = outcome.system;
  PoseEstimate pose;
  pose.T_world_camera = outcome.T_world_camera;
  pose.free_directions = outcome.step.free_directions;
  const double met = overlapOf(system, origin);
  if (met > 0) pose.inlier_fraction = system.inliers / met;
  if (system.inliers > 0) pose.rmse_m = std::sqrt(system.squared_error / system.inliers);

  const double overlap = outcome.pixels > 0 ? met / outcome.pixels : 0;
  const bool on_little = met < kMuchIsKnown * system.readings;
  if (!outcome.step.finite || pose.inlier_fraction < kLostInlierFraction || overlap < kLostOverlap) {
    pose.state = TrackingState::lost;
    return pose;
  }
  const Eigen::Isometry3d motion = begin.inverse() * outcome.T_world_camera;
  const double angle_rad = Eigen::AngleAxisd(motion.linear()).angle();
  const double distance_m = motion.translation().norm();
  const bool by_landmarks = origin == GuessOrigin::landmarks || origin == GuessOrigin::key_frame;
  const Evidence& requested = requiredEvidence(origin, on_little, angle_rad, distance_m);
  const bool within_reach = by_landmarks ? outcome.landmark_error_px <= kLandmarksAgree_px
                                         : angle_rad < kReach_rad && distance_m < kReach_m;
  const bool is_determined = pose.free_directions == 0 || by_landmarks || origin == GuessOrigin::device;
  const bool trusted = is_determined && isAtRest(outcome.step) && within_reach &&
                       system.fit_residual_m <= requested.residual * depth_noise_m &&
                       pose.inlier_fraction >= requested.inlier_fraction && overlap >= kTrustedOverlap &&
                       (!on_little || outcome.step.is_firm);
  pose.state = trusted ? TrackingState::tracking : TrackingState::uncertain;
  return pose;
}

}  // namespace scantrove
