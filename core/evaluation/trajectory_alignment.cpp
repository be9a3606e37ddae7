#include "core/evaluation/trajectory_alignment.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

namespace scantrove {
namespace {

std::size_t nearestIndex(std::span<const StampedPose> poses, double timestamp_s) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), timestamp_s,
                                      [](const StampedPose& pose, double t) { return pose.timestamp_s < t; });
  if (after == poses.begin()) return 0;
  if (after == poses.end()) return poses.size() - 1;
  const auto before = std::prev(after);
  const bool before_is_nearer = timestamp_s - before->timestamp_s <= after->timestamp_s - timestamp_s;
  return static_cast<std::size_t>((before_is_nearer ? before : after) - poses.begin());
}

}  // namespace

std::vector<PosePair> associate(std::span<const StampedPose> estimate, std::span<const StampedPose> truth,
                                double max_difference_s) {
  if (truth.empty()) return {};
  std::vector<std::optional<std::size_t>> estimate_of_truth(truth.size());
  const auto distance = [&](std::size_t e, std::size_t t) {
    return std::abs(estimate[e].timestamp_s - truth[t].timestamp_s);
  };
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    const std::size_t t = nearestIndex(truth, estimate[e].timestamp_s);
    // Recordings print times with four to six digits: rounding must not decide whether a difference equals
    // the limit.
    if (distance(e, t) > max_difference_s + 1e-9) continue;
    std::optional<std::size_t>& nearest = estimate_of_truth[t];
    if (!nearest || distance(e, t) < distance(*nearest, t)) nearest = e;
  }
  std::vector<PosePair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    if (estimate_of_truth[t]) pairs.push_back({estimate[*estimate_of_truth[t]], truth[t]});
  }
  return pairs;
}

Eigen::Isometry3d alignRigidly(std::span<const PosePair> pairs) {
  if (pairs.empty()) return Eigen::Isometry3d::Identity();
  const double count = static_cast<double>(pairs.size());
  Eigen::Vector3d estimate_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d truth_mean = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    estimate_mean += pair.estimate.T_world_camera.translation() / count;
    truth_mean += pair.truth.T_world_camera.translation() / count;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs) {
    covariance += (pair.truth.T_world_camera.translation() - truth_mean) *
                  (pair.estimate.T_world_camera.translation() - estimate_mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;  // excludes reflections
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  T.translation() = truth_mean - T.linear() * estimate_mean;
  return T;
}

}  // namespace scantrove
