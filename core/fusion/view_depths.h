#pragma once

namespace scantrove {

/// Near plane of all views of the map, in metres. Nearer bricks are neither updated nor seen.
inline constexpr float kNearestView_m = 0.05F;

}  // namespace scantrove
