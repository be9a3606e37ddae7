#include "core/synthetic/device_path.h"

#include <cmath>
#include <numbers>

#include "core/synthetic/hash_random.h"

namespace scantrove::synthetic {
namespace {

/// Normally distributed, by the method of Box and Muller.
double normalNumber(std::uint32_t index, std::uint32_t channel, std::uint32_t seed) {
  constexpr std::uint32_t kPurpose = 41;
  const auto uniform = [&](std::uint32_t which) {
    return static_cast<double>(hashUniform(hashBits(index, 2 * channel + which, kPurpose, seed)));
  };
  return std::sqrt(-2 * std::log(1 - uniform(0))) * std::cos(2 * std::numbers::pi * uniform(1));
}

}  // namespace

Eigen::Isometry3d DevicePath::pose(int index) {
  if (drifted_.empty()) drifted_.push_back(true_pose_(0));
  for (int i = static_cast<int>(drifted_.size()); i <= index; ++i) {
    Eigen::Isometry3d motion = true_pose_(i - 1).inverse() * true_pose_(i);
    const double way_m = motion.translation().norm();
    motion.translation() *= errors_.scale;
    motion.rotate(Eigen::AngleAxisd(errors_.turn_rad_per_m * way_m, Eigen::Vector3d::UnitY()));
    drifted_.push_back(drifted_.back() * motion);
  }
  const auto number = static_cast<std::uint32_t>(index);
  const auto noise = [&](std::uint32_t channel) {
    return Eigen::Vector3d(normalNumber(number, channel, seed_), normalNumber(number, channel + 1, seed_),
                           normalNumber(number, channel + 2, seed_));
  };
  Eigen::Isometry3d pose = drifted_[static_cast<std::size_t>(index)];
  pose.translate(errors_.noise_m * noise(0));
  const Eigen::Vector3d turn = errors_.noise_rad * noise(3);
  if (turn.norm() > 0) pose.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  if (errors_.jump_at && index >= *errors_.jump_at)
    pose.pretranslate(errors_.jump_m * Eigen::Vector3d::UnitX());
  pose.pretranslate(errors_.origin_m);
  pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return pose;
}

}  // namespace scantrove::synthetic
