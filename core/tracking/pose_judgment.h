#pragma once
#include "core/tracking/icp_system.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// Result of ICP.
struct IcpOutcome {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  IcpSystem system;              ///< of the last pass, at the finest level
  IcpStep step;                  ///< of the last pass
  int pixels = 0;                ///< of the finest level
  double landmark_error_px = 0;  ///< SeenLandmarks::errorPx; 0 without landmarks
};

/// Source of the pose from which ICP began. The less is known beforehand, the likelier is a false minimum.
enum class GuessOrigin {
  prediction,  ///< the camera's last motion
  device,      ///< the motion of a device that tracks itself; it determines directions that surface does not
  search,      ///< the best of many guesses
  landmarks,   ///< landmarks or corners, for a camera that is followed
  key_frame    ///< landmarks of a key frame, for a lost camera; a similar place may be mistaken for it
};

/// Decides whether the pose may be trusted, and computes its figures. `begin`: where ICP began (for a
/// prediction: the pose of the model; for a device: its prediction). `depth_noise_m`: FusionParams.
///
/// A trusted pose has converged, its residual is the camera's noise, enough of the readings on known surface
/// fit it, and the geometry or landmarks determine it. For a followed camera, readings in front of known
/// surface do not count against the pose as far as they outnumber those behind: objects may appear, but
/// surfaces are not transparent. If less than a fifth of the readings meets known surface, that surface must
/// determine the pose well and fit better. A pose that might corrupt the map is never `tracking`.
[[nodiscard]] PoseEstimate judgePose(const IcpOutcome& outcome, const Eigen::Isometry3d& begin,
                                     GuessOrigin origin, double depth_noise_m);

/// Whether ICP against a stored surface, from the pose `by_map`, confirms that the camera sees it again. At
/// least half of the readings must meet it, most of these must fit, they must determine the pose well, and
/// the correction must be within the possible drift of a map.
[[nodiscard]] bool isSeenAgain(const IcpOutcome& outcome, const Eigen::Isometry3d& by_map);

}  // namespace scantrove
