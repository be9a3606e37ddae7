#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

namespace scantrove {

/// Which frames show something new: one each 5 degrees or 7.5 cm from all that were taken.
class KeyFrameChoice {
 public:
  KeyFrameChoice() = default;
  explicit KeyFrameChoice(std::vector<Eigen::Isometry3d> taken) : taken_(std::move(taken)) {}

  /// Whether this one does; then it is taken.
  bool takes(const Eigen::Isometry3d& T_world_camera) {
    const bool is_new = std::ranges::none_of(taken_, [&](const Eigen::Isometry3d& other) {
      const Eigen::Isometry3d motion = other.inverse() * T_world_camera;
      return motion.translation().norm() < 0.075 && Eigen::AngleAxisd(motion.linear()).angle() < 0.0873;
    });
    if (is_new) taken_.push_back(T_world_camera);
    return is_new;
  }

 private:
  std::vector<Eigen::Isometry3d> taken_;
};

}  // namespace scantrove
