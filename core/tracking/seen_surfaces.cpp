#include "core/tracking/seen_surfaces.h"

#include <algorithm>

#include "core/tracking/view_distance.h"

namespace scantrove {
namespace {

/// Within this distance a registration is accurate to some millimetres, on recordings of structured-light
/// cameras.
constexpr ViewReach kHandsWidth{.angle_rad = 0.10, .distance_m = 0.09};
/// Beyond this distance the camera has left the place.
constexpr ViewReach kAway{.angle_rad = 0.55, .distance_m = 0.50};

}  // namespace

bool SeenSurfaces::isDue(const Eigen::Isometry3d& T_world_camera) const {
  return std::ranges::none_of(views_, [&](const View& view) {
    return viewDistance(view.T_world_camera, T_world_camera, kHandsWidth) < 1;
  });
}

void SeenSurfaces::markRevisitable(const Eigen::Isometry3d& T_world_camera) {
  for (View& view : views_) {
    if (!view.is_revisitable)
      view.is_revisitable = viewDistance(view.T_world_camera, T_world_camera, kAway) > 1;
  }
}

const SeenSurfaces::View* SeenSurfaces::nearestSeenAgain(const Eigen::Isometry3d& T_world_camera) const {
  const View* best = nullptr;
  double least = 1;
  for (const View& view : views_) {
    if (!view.is_revisitable) continue;
    const double distance = viewDistance(view.T_world_camera, T_world_camera, kHandsWidth);
    if (distance >= least) continue;
    least = distance;
    best = &view;
  }
  return best;
}

}  // namespace scantrove
