#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

namespace scantrove {

/// Selects frames that show something new: those rotated or moved far enough from all selected ones.
class KeyFrameChoice {
 public:
  /// With less motion the camera sees the same sides of an object at arm's length (75 cm: 5.7 degrees).
  static constexpr double kMinMotion_m = 0.075;
  /// 5 degrees: with less rotation nine tenths of the image are the same.
  static constexpr double kMinTurn_rad = 0.0873;

  KeyFrameChoice() = default;
  explicit KeyFrameChoice(std::vector<Eigen::Isometry3d> taken) : taken_(std::move(taken)) {}

  /// Whether no selected frame shows the same.
  [[nodiscard]] bool isNew(const Eigen::Isometry3d& T_world_camera) const {
    return std::ranges::none_of(taken_, [&](const Eigen::Isometry3d& other) {
      const Eigen::Isometry3d motion = other.inverse() * T_world_camera;
      return motion.translation().norm() < kMinMotion_m &&
             Eigen::AngleAxisd(motion.linear()).angle() < kMinTurn_rad;
    });
  }
  /// Whether the frame is selected; it then counts as taken.
  bool takes(const Eigen::Isometry3d& T_world_camera) {
    const bool is_new = isNew(T_world_camera);
    if (is_new) taken_.push_back(T_world_camera);
    return is_new;
  }

 private:
  std::vector<Eigen::Isometry3d> taken_;
};

}  // namespace scantrove
