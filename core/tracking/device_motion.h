#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/tracking/view_distance.h"

namespace scantrove {

/// The poses of a device that tracks itself (ARKit, odometry), as a prediction of the camera's pose in the
/// map. Between frames the device's motion is precise; over a scan it drifts. Hence only its motion since the
/// last frame counts: the transform from the device's world to the map's is set anew with each frame, so it
/// follows the drift slowly. A jump of the device is no motion. Double precision; any thread, one at a time.
class DeviceMotion {
 public:
  /// Where the device says that the camera is.
  struct Prediction {
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    /// How far the device may be wrong: more, the farther it moved since the map confirmed its pose.
    ViewReach noise{};
    /// Where the device jumped to; then T_world_camera continues the motion before. None: it did not jump.
    std::optional<Eigen::Isometry3d> T_world_jumped = {};

    /// Whether the map's pose is within the noise. `is_firm`: surface or landmarks determine that pose well;
    /// such a pose may also show that the device corrected itself by a little.
    [[nodiscard]] bool agrees(const Eigen::Isometry3d& by_map, bool is_firm) const;
  };

  /// None: the device's world has no place in the map yet. `T_device_camera`: the device's pose;
  /// `time_s`: of the frame.
  [[nodiscard]] std::optional<Prediction> predict(const Eigen::Isometry3d& T_device_camera,
                                                  double time_s) const;

  /// What the map says about a frame's pose.
  enum class Support {
    firm,     ///< it determines the pose well
    partial,  ///< it fits, and determines some directions
    none,     ///< nothing: the pose is the prediction
  };
  /// Call with the final pose of each frame that has a device's pose.
  void update(const Eigen::Isometry3d& T_device_camera, double time_s,
              const Eigen::Isometry3d& T_world_camera, Support support);

  /// A motion between two frames.
  struct Motion {
    /// Rotation in the camera's frame, translation in the device's world: a camera may pan while it walks on.
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    double duration_s = 0;  ///< 0: unknown

    [[nodiscard]] bool isKnown() const { return duration_s > 0; }
  };
  /// State for a later scan of the same map.
  struct Memory {
    Eigen::Isometry3d T_device_camera = Eigen::Isometry3d::Identity();  ///< of the last frame
    double time_s = 0;                                                  ///< likewise
    Eigen::Isometry3d T_world_device = Eigen::Isometry3d::Identity();  ///< from the device's world to the map
    Motion motion{};  ///< to the last frame, or before a jump to it
    Motion jump{};    ///< to the last frame, if it was a jump; else unknown
    /// How far the device may have drifted since the map confirmed its pose.
    ViewReach drift{};
  };
  /// None: see predict().
  [[nodiscard]] const std::optional<Memory>& memory() const { return state_; }
  /// The recording goes on, in the same world of the device.
  void restore(const Memory& memory) { state_ = memory; }
  /// The device's world has no place in the map any more.
  void forget() { state_.reset(); }

 private:
  std::optional<Memory> state_;
};

}  // namespace scantrove
