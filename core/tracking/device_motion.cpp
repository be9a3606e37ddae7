#include "core/tracking/device_motion.h"

#include <algorithm>

namespace scantrove {
namespace {

/// Noise of the motion between two frames. A device's pose and its depth image may be 10 ms apart, which at
/// 2 m/s and 1 rad/s is 2 cm and 0.01 rad; the registration itself is good to a centimetre.
constexpr ViewReach kNoise{.angle_rad = 0.02, .distance_m = 0.03};
/// Visual-inertial odometry drifts by about 1 % of the way and 0.5 degrees a metre; three times that.
constexpr ViewReach kDriftPerMeter{.angle_rad = 0.025, .distance_m = 0.03};
/// Turning on the spot moves the camera, which is not in the turning axis, and blurs its images.
constexpr ViewReach kDriftPerRadian{.angle_rad = 0.03, .distance_m = 0.05};
/// A prediction that is wrong by more is no help for finding the right one of two similar places.
constexpr ViewReach kMostDrift{.angle_rad = 0.25, .distance_m = 0.5};
/// Devices correct their own drift in steps of up to a decimetre. Surface that determines the pose well shows
/// such a step, and a false minimum of ICP lies farther away.
constexpr ViewReach kOwnCorrection{.angle_rad = 0.05, .distance_m = 0.10};

/// A device jumps if its motion differs from the one before by more than this ...
constexpr ViewReach kDeviceJump{.angle_rad = 0.2, .distance_m = 0.1};
/// ... and more than a person accelerates, in rad/s^2 and m/s^2 ...
constexpr ViewReach kAcceleration{.angle_rad = 8, .distance_m = 3};
/// ... and this part of the motion, since frames that lie far apart show more of it, even if their times are
/// unknown. At 1.4 m/s that makes 11 cm at 30 Hz, and 28 cm at 5 Hz.
constexpr double kChangeOfMotion = 0.2;
/// The first motion has none before it. Nobody moves farther between two frames.
constexpr ViewReach kFirstJump{.angle_rad = 1.5, .distance_m = 1.5};
/// After a longer pause the motion before says nothing.
constexpr double kLongestPause_s = 1.5;
/// It is extrapolated for no more times its duration.
constexpr double kMostTimes = 2;
/// For sources whose times do not grow.
constexpr double kUsualInterval_s = 1.0 / 30;

ViewReach sum(const ViewReach& a, const ViewReach& b) {
  return {a.angle_rad + b.angle_rad, a.distance_m + b.distance_m};
}

ViewReach times(double factor, const ViewReach& reach) {
  return {factor * reach.angle_rad, factor * reach.distance_m};
}

ViewReach limited(const ViewReach& reach) {
  return {std::min(reach.angle_rad, kMostDrift.angle_rad), std::min(reach.distance_m, kMostDrift.distance_m)};
}

ViewReach lengthOf(const Eigen::Isometry3d& motion) {
  return {Eigen::AngleAxisd(motion.linear()).angle(), motion.translation().norm()};
}

ViewReach driftOver(const ViewReach& way) {
  return sum(times(way.distance_m, kDriftPerMeter), times(way.angle_rad, kDriftPerRadian));
}

Eigen::Isometry3d exactPose(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d exact = T;
  exact.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return exact;
}

/// `motion` at the same speed for `factor` times as long.
Eigen::Isometry3d scaled(const Eigen::Isometry3d& motion, double factor) {
  const Eigen::AngleAxisd turn(motion.linear());
  Eigen::Isometry3d result(Eigen::AngleAxisd(factor * turn.angle(), turn.axis()));
  result.translation() = factor * motion.translation();
  return result;
}

/// DeviceMotion::Motion::motion between two poses.
Eigen::Isometry3d motionBetween(const Eigen::Isometry3d& before, const Eigen::Isometry3d& after) {
  Eigen::Isometry3d motion(Eigen::Isometry3d(before.inverse() * after).linear());
  motion.translation() = after.translation() - before.translation();
  return motion;
}

Eigen::Isometry3d poseAfter(const Eigen::Isometry3d& before, const Eigen::Isometry3d& motion) {
  Eigen::Isometry3d after(before.linear() * motion.linear());
  after.translation() = before.translation() + motion.translation();
  return after;
}

/// The motion of a frame after the last one, and where it should be if the device did not jump.
struct Step {
  DeviceMotion::Motion motion;
  Eigen::Isometry3d expected;  ///< T_device_camera
  ViewReach deviation;         ///< from there
  bool is_jump;
};

/// `before`: the motion to the last frame.
Step stepAfter(const DeviceMotion::Motion& before, const DeviceMotion::Memory& last,
               const Eigen::Isometry3d& T_device_camera, const DeviceMotion::Motion& motion) {
  const double interval_s = motion.duration_s;
  const bool is_pause = interval_s > kLongestPause_s;
  Step step{motion, last.T_device_camera, {}, false};
  ViewReach limit = is_pause ? times(interval_s, kFirstJump) : kFirstJump;
  if (before.isKnown() && !is_pause) {
    const Eigen::Isometry3d expected =
        scaled(before.motion, std::min(interval_s / before.duration_s, kMostTimes));
    step.expected = poseAfter(last.T_device_camera, expected);
    limit = sum(kDeviceJump, times(interval_s * interval_s, kAcceleration));
    limit = sum(limit, times(kChangeOfMotion, lengthOf(expected)));
  }
  step.deviation = lengthOf(step.expected.inverse() * T_device_camera);
  step.is_jump = step.deviation.angle_rad > limit.angle_rad || step.deviation.distance_m > limit.distance_m;
  return step;
}

Step stepTo(const DeviceMotion::Memory& last, const Eigen::Isometry3d& T_device_camera, double time_s) {
  const DeviceMotion::Motion motion{motionBetween(last.T_device_camera, T_device_camera),
                                    time_s > last.time_s ? time_s - last.time_s : kUsualInterval_s};
  const Step step = stepAfter(last.motion, last, T_device_camera, motion);
  if (!step.is_jump || !last.jump.isKnown()) return step;
  // The camera goes on as it seemed to jump, so that was its motion.
  const Step as_before = stepAfter(last.jump, last, T_device_camera, motion);
  return as_before.is_jump ? step : as_before;
}

}  // namespace

bool DeviceMotion::Prediction::agrees(const Eigen::Isometry3d& by_map, bool is_firm) const {
  return viewDistance(T_world_camera, by_map, is_firm ? sum(noise, kOwnCorrection) : noise) <= 1;
}

std::optional<DeviceMotion::Prediction> DeviceMotion::predict(const Eigen::Isometry3d& T_device_camera,
                                                              double time_s) const {
  if (!state_) return std::nullopt;
  const Step step = stepTo(*state_, T_device_camera, time_s);
  Prediction prediction;
  prediction.noise = sum(kNoise, limited(sum(state_->drift, driftOver(lengthOf(step.motion.motion)))));
  prediction.T_world_camera = exactPose(state_->T_world_device * T_device_camera);
  if (!step.is_jump) return prediction;
  prediction.T_world_jumped = prediction.T_world_camera;
  prediction.noise = sum(prediction.noise, step.deviation);
  prediction.T_world_camera = exactPose(state_->T_world_device * step.expected);
  return prediction;
}

void DeviceMotion::update(const Eigen::Isometry3d& T_device_camera, double time_s,
                          const Eigen::Isometry3d& T_world_camera, Support support) {
  Memory next;
  next.T_device_camera = T_device_camera;
  next.time_s = time_s;
  next.T_world_device = exactPose(T_world_camera * T_device_camera.inverse());
  if (state_) {
    const Step step = stepTo(*state_, T_device_camera, time_s);
    next.motion = step.is_jump ? state_->motion : step.motion;
    if (step.is_jump) next.jump = step.motion;
    const ViewReach added = step.is_jump ? step.deviation : driftOver(lengthOf(step.motion.motion));
    next.drift = limited(sum(state_->drift, added));
  }
  if (support == Support::firm) next.drift = {};
  state_ = next;
}

}  // namespace scantrove
