#pragma once

namespace scantrove {

/// Where views of the map begin, in metres before the camera: bricks nearer than this are neither updated nor
/// seen.
inline constexpr float kNearestView_m = 0.05F;

}  // namespace scantrove
