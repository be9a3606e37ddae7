#pragma once
#include "core/tracking/icp_system.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// What is known when ICP has ended.
struct IcpOutcome {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  IcpSystem system;              ///< of the last pass, at the finest level
  IcpStep step;                  ///< of the last pass
  int pixels = 0;                ///< of the finest level
  double landmark_error_px = 0;  ///< SeenLandmarks::errorPx, where there are landmarks
};

/// Where ICP began: the less is known beforehand, the more room there is for a false minimum.
enum class PoseOrigin {
  prediction,  ///< the camera's motion so far
  search,      ///< the best of many guesses
  landmarks,   ///< where the colour image, by itself, has a camera that was followed until now
  place        ///< where it has a camera that was lost: by chance it may look like somewhere else
};

/// Whether the pose may be trusted, with its figures. `begin`: where ICP began (for a prediction: the pose of
/// the model). `depth_noise_m`: FusionParams. A pose rests on the surface that it explains: it lies still,
/// its residual is the camera's noise, enough of what meets known surface fits it, and the geometry
/// determines it or landmarks do. Where the camera is followed, readings before known surface are not held
/// against it, as far as they outnumber those behind: things come into view, but nothing is seen through.
/// When less than a fifth of the readings meets known surface, that must determine the pose well and fit
/// better. No pose is called `tracking` that might corrupt the map.
[[nodiscard]] PoseEstimate judgePose(const IcpOutcome& outcome, const Eigen::Isometry3d& begin,
                                     PoseOrigin origin, double depth_noise_m);

/// Whether ICP against what a key frame saw, from the pose `by_map`, shows the same view again: half of what
/// is seen meets it, fits it and determines the pose firmly, within what a map may have drifted.
[[nodiscard]] bool isSeenAgain(const IcpOutcome& outcome, const Eigen::Isometry3d& by_map);

}  // namespace scantrove
