#pragma once
#include <array>
#include <cstdint>

#include "core/base/ids.h"

namespace scantrove {

/// Colour (red, green, blue) by which files show a region: the same for the same id in every scan,
/// neighbouring ids far apart in hue; id 0 (unlabelled) is mid grey.
[[nodiscard]] std::array<std::uint8_t, 3> regionColor(RegionId region);

}  // namespace scantrove
