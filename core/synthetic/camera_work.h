#pragma once
#include <optional>
#include <vector>

#include "core/synthetic/layout.h"
#include "core/synthetic/trajectory.h"

namespace scantrove::synthetic {

/// A B-spline through the points, forth and back for ever, as fast as a careful hand: at most 0.30 m/s and 20
/// degrees/s.
[[nodiscard]] CameraPath alongAtHandsPace(std::vector<Gaze> points);

/// Whether the camera passes things as near as 0.2 m on the path's first `seconds`, much of the image is
/// nearer than 0.9 m, and yet every view shows surfaces that fix the camera's place.
[[nodiscard]] bool passesNear(const Layout& layout, const CameraPath& path, double seconds);

/// Looks at the scene from the path's first `seconds`: how many of the views (two a second) are bad. Bad is
/// an eye nearer than 0.3 m to something, a middle nearer than 0.6 m or farther than 2.5 m, too much that has
/// no depth, fewer than seven things, or surfaces that leave the camera's place open. Stops counting at
/// `enough`.
[[nodiscard]] int countBadViews(const Layout& layout, const CameraPath& path, double seconds, int enough);

}  // namespace scantrove::synthetic
