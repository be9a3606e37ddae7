#pragma once
#include <optional>
#include <vector>

#include "core/synthetic/layout.h"
#include "core/synthetic/trajectory.h"

namespace scantrove::synthetic {

/// A B-spline through the points, back and forth forever, at a careful hand's speed: at most 0.30 m/s and 20
/// degrees/s.
[[nodiscard]] CameraPath alongAtHandsPace(std::vector<Gaze> points);

/// Whether, in the path's first `seconds`, the camera passes things as near as 0.2 m and much of the image is
/// nearer than 0.9 m. Every view must still show surfaces that determine the camera's pose.
[[nodiscard]] bool passesNear(const Layout& layout, const CameraPath& path, double seconds);

/// Counts bad views (two a second) in the path's first `seconds`. A view is bad if the eye is within 0.3 m of
/// something, or the image centre is nearer than 0.6 m or farther than 2.5 m. It is also bad with too much
/// missing depth, fewer than seven things, or surfaces that leave the camera's pose undetermined. Stops
/// counting at `enough`.
[[nodiscard]] int countBadViews(const Layout& layout, const CameraPath& path, double seconds, int enough);

}  // namespace scantrove::synthetic
