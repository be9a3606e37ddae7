#pragma once
#include <Eigen/Geometry>
#include <span>
#include <utility>
#include <vector>

#include "core/base/stamped_pose.h"

namespace scantrove {

/// An estimated pose and the true pose of the same moment.
struct PosePair {
  StampedPose estimate;
  StampedPose truth;
};

/// Pairs each estimate with the truth nearest in time, at most `max_difference_s` away. Each truth is used
/// once, for the nearest estimate (ties: the earlier). Inputs and result are ordered by time.
[[nodiscard]] std::vector<PosePair> associate(std::span<const StampedPose> estimate,
                                              std::span<const StampedPose> truth,
                                              double max_difference_s = 0.02);

/// The rigid motion (no scale) T that minimises sum |truth - T * estimate|^2 over the pairs' positions
/// (Umeyama 1991). If the positions do not determine the rotation (all in one point or on one line), any
/// minimiser is returned.
[[nodiscard]] Eigen::Isometry3d alignRigidly(std::span<const PosePair> pairs);

}  // namespace scantrove
