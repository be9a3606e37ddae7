#include "core/tracking/pose_judgment.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

// Under these a pose is lost.
constexpr double kLostInlierFraction = 0.10;
constexpr double kLostOverlap = 0.02;  // pixels that meet the model / pixels of the image
// Over these it may be trusted.
constexpr double kTrustedOverlap = 0.06;
// Known surface is most of what is seen above this, as pixels that meet the model / pixels with depth.
constexpr double kMuchIsKnown = 0.20;
// A wrong pose has readings before and behind the surface; so many of those behind speak against as many
// before.
constexpr double kBeforePerBehind = 2;
// A trusted pose has come to rest and lies within a hand's reach of the last one.
constexpr double kRest_rad = 0.001;
constexpr double kRest_m = 0.002;
constexpr double kReach_rad = 0.5;
constexpr double kReach_m = 0.3;

/// What a pose must show. Residuals grow with the noise of the camera and are counted in it. On recordings of
/// structured-light cameras right poses left 2 to 5.3, with 0.7 to 0.95 inliers even over far motions; wrong
/// ones 4 to 13 with 0.75 inliers at most. After a small motion a wrong pose is unlikely and half-seen
/// surfaces are common; the more room there was for a false minimum, the more must be shown.
struct Evidence {
  double inlier_fraction;
  double residual;  ///< IcpSystem::fit_residual_m / FusionParams::depth_noise_m
};
// What a pose must show to be trusted. The less was known of where the camera is, the more: after a small
// motion least, after a search most. Where little of the map is in view, or a key frame was found, as after a
// far motion. Landmarks that agree stand for much of the surface.
constexpr Evidence kAfterSmallMotion{.inlier_fraction = 0.50, .residual = 7.6};
constexpr Evidence kAfterFarMotion{.inlier_fraction = 0.70, .residual = 6.0};
constexpr Evidence kAfterSearch{.inlier_fraction = 0.78, .residual = 4.6};
constexpr Evidence kOnLittle{.inlier_fraction = 0.70, .residual = 6.0};
constexpr Evidence kAtLandmarks{.inlier_fraction = 0.40, .residual = 20};
constexpr Evidence kAtKeyFrame{.inlier_fraction = 0.70, .residual = 6.0};
// Landmarks that are seen so near to where the pose has them agree with it.
constexpr double kLandmarksAgree_px = 3;
constexpr double kFar_rad = 0.07;  // motions in one frame from here on are far
constexpr double kFar_m = 0.08;

const Evidence& requiredEvidence(PoseOrigin origin, bool on_little, double angle_rad, double distance_m) {
  if (origin == PoseOrigin::search) return kAfterSearch;
  if (origin == PoseOrigin::landmarks) return kAtLandmarks;
  if (origin == PoseOrigin::place) return kAtKeyFrame;
  if (on_little) return kOnLittle;
  return angle_rad > kFar_rad || distance_m > kFar_m ? kAfterFarMotion : kAfterSmallMotion;
}

/// Pixels that meet known surface, but for those that something new may be seen in.
double overlapOf(const IcpSystem& system, PoseOrigin origin) {
  if (origin == PoseOrigin::search || origin == PoseOrigin::place) return system.overlap;
  return system.overlap - std::max(0.0, system.before - kBeforePerBehind * system.behind);
}

// The same view again.
constexpr double kSeenAgain = 0.5;      // part of the readings that meets what was seen then
constexpr double kFitsAgain = 0.75;     // and of these, part that fits
constexpr double kMaxDrift_rad = 0.05;  // a map's, over a loop in a room
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

PoseEstimate judgePose(const IcpOutcome& outcome, const Eigen::Isometry3d& begin, PoseOrigin origin,
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
  const bool by_landmarks = origin == PoseOrigin::landmarks || origin == PoseOrigin::place;
  const Evidence& requested = requiredEvidence(origin, on_little, angle_rad, distance_m);
  const bool within_reach = by_landmarks ? outcome.landmark_error_px <= kLandmarksAgree_px
                                         : angle_rad < kReach_rad && distance_m < kReach_m;
  const bool trusted = (pose.free_directions == 0 || by_landmarks) && isAtRest(outcome.step) &&
                       within_reach && system.fit_residual_m <= requested.residual * depth_noise_m &&
                       pose.inlier_fraction >= requested.inlier_fraction && overlap >= kTrustedOverlap &&
                       (!on_little || outcome.step.is_firm);
  pose.state = trusted ? TrackingState::tracking : TrackingState::uncertain;
  return pose;
}

}  // namespace scantrove
