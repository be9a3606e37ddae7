#pragma once
#include <Eigen/Geometry>
#include <optional>

namespace scantrove {

/// Whether the pose of a frame may be trusted. Only `tracking` and `relocalised` frames touch map and labels.
enum class TrackingState { tracking, uncertain, lost, relocalized };

[[nodiscard]] constexpr const char* toString(TrackingState state) {
  switch (state) {
    case TrackingState::tracking:
      return "tracking";
    case TrackingState::uncertain:
      return "uncertain";
    case TrackingState::lost:
      return "lost";
    case TrackingState::relocalized:
      return "relocalised";
  }
  return "";
}

/// The pose of one frame as a value with a state.
struct PoseEstimate {
  TrackingState state = TrackingState::lost;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  double inlier_fraction = 0;  ///< associated pixels / pixels that meet known surface (judgePose)
  double rmse_m = 0;           ///< point-to-plane, over the inliers
  /// At a revisited place: the drift of the map since, which is removed from the pose.
  std::optional<double> drift_m = {};
  int free_directions = 0;  ///< directions of motion that the geometry does not determine
  /// Usable, but not confirmed by the map: it follows the motion of a device that tracks itself.
  bool is_by_device = false;
  bool has_device_jumped = false;  ///< the device's pose jumped in this frame and was not believed

  [[nodiscard]] bool usable() const {
    return state == TrackingState::tracking || state == TrackingState::relocalized;
  }
};

}  // namespace scantrove
