#pragma once
#include <Eigen/Geometry>

namespace scantrove {

/// The camera's next pose if it continues its motion from `before_last` to `last` (both camera to world) at
/// `damping` of that speed. Hands slow down more often than they speed up, and noise of the poses must not be
/// extrapolated in full.
[[nodiscard]] inline Eigen::Isometry3d predictPose(const Eigen::Isometry3d& last,
                                                   const Eigen::Isometry3d& before_last,
                                                   double damping = 0.8) {
  const Eigen::Isometry3d motion = before_last.inverse() * last;  // in the camera's frame
  const Eigen::Quaterniond rotation(motion.linear());
  Eigen::Isometry3d damped = Eigen::Isometry3d::Identity();
  damped.linear() = Eigen::Quaterniond::Identity().slerp(damping, rotation).toRotationMatrix();
  damped.translation() = damping * motion.translation();
  Eigen::Isometry3d predicted = last * damped;
  predicted.linear() = Eigen::Quaterniond(predicted.linear()).normalized().toRotationMatrix();
  return predicted;
}

}  // namespace scantrove
