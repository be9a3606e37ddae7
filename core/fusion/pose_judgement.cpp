#include "core/fusion/pose_judgement.h"

#include <cmath>

namespace scantrove {
namespace {

// A pose is lost under the first, and trusted over the second of each pair.
constexpr double kLostInlierFraction = 0.10;
constexpr double kTrustedInlierFraction = 0.40;
constexpr double kLostOverlap = 0.02;  // pixels that meet the model / pixels of the image
constexpr double kTrustedOverlap = 0.06;
constexpr double kTrustedOverlapOfReadings = 0.20;  // pixels that meet the model / pixels with depth
// A trusted pose has come to rest and lies within a hand's reach of the last one.
constexpr double kRest_rad = 0.004;
constexpr double kRest_m = 0.004;
constexpr double kReach_rad = 0.5;
constexpr double kReach_m = 0.3;
constexpr double kTrustedRmse_m = 0.03;

}  // namespace

PoseEstimate judgePose(const IcpOutcome& outcome, const Eigen::Isometry3d& motion) {
  const IcpSystem& system = outcome.system;
  PoseEstimate pose;
  pose.T_world_camera = outcome.T_world_camera;
  pose.free_directions = outcome.step.free_directions;
  if (system.overlap > 0) pose.inlier_fraction = static_cast<double>(system.inliers) / system.overlap;
  if (system.inliers > 0) pose.rmse_m = std::sqrt(system.squared_error / system.inliers);

  const double overlap = outcome.pixels > 0 ? static_cast<double>(system.overlap) / outcome.pixels : 0;
  const double overlap_of_readings =
      system.readings > 0 ? static_cast<double>(system.overlap) / system.readings : 0;
  if (!outcome.step.finite || pose.inlier_fraction < kLostInlierFraction || overlap < kLostOverlap) {
    pose.state = TrackingState::lost;
    return pose;
  }
  const bool at_rest = outcome.step.rotation_rad < kRest_rad && outcome.step.translation_m < kRest_m;
  const bool plausible =
      Eigen::AngleAxisd(motion.linear()).angle() < kReach_rad && motion.translation().norm() < kReach_m;
  const bool trusted = pose.free_directions == 0 && at_rest && plausible && pose.rmse_m < kTrustedRmse_m &&
                       pose.inlier_fraction >= kTrustedInlierFraction && overlap >= kTrustedOverlap &&
                       overlap_of_readings >= kTrustedOverlapOfReadings;
  pose.state = trusted ? TrackingState::tracking : TrackingState::uncertain;
  return pose;
}

}  // namespace scantrove
