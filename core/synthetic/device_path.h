#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace scantrove::synthetic {

/// The errors of a device that tracks itself by camera and inertia. The defaults are those of a phone.
struct DeviceErrors {
  double scale = 1.01;                                 ///< length of its way / true length
  double turn_rad_per_m = 0.0005;                      ///< drift about the vertical axis of the camera
  double noise_m = 0.001;                              ///< of each pose, standard deviation per axis
  double noise_rad = 0.0005;                           ///< likewise
  std::optional<int> jump_at = {};                     ///< first frame after a jump of its world
  double jump_m = 0.5;                                 ///< along the world's x axis
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< of the true world, in the device's
};

/// The poses that such a device reports on a true path. A pose depends on the frame's index only. One thread.
class DevicePath {
 public:
  /// `true_pose`: T_world_camera of a frame, from index 0 on.
  DevicePath(const DeviceErrors& errors, std::uint32_t seed, std::function<Eigen::Isometry3d(int)> true_pose)
      : errors_(errors), seed_(seed), true_pose_(std::move(true_pose)) {}

  /// The device's T_world_camera.
  [[nodiscard]] Eigen::Isometry3d pose(int index);

 private:
  DeviceErrors errors_;
  std::uint32_t seed_;
  std::function<Eigen::Isometry3d(int)> true_pose_;
  std::vector<Eigen::Isometry3d> drifted_;  // by index, without noise and jump
};

}  // namespace scantrove::synthetic
