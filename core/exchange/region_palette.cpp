#include "core/exchange/region_palette.h"

#include <algorithm>
#include <cmath>

namespace scantrove {

std::array<std::uint8_t, 3> regionColor(RegionId region) {
  if (!region) return {128, 128, 128};
  // Steps of the golden angle never crowd the hue circle; three tones keep ids apart whose hues come close.
  const double turns = static_cast<double>(region.value) * 0.618033988749895;
  const double hue = 6.0 * (turns - std::floor(turns));
  const double saturation = 0.55 + 0.15 * static_cast<double>(region.value % 3);
  const double value = 0.75 + 0.12 * static_cast<double>(region.value / 3 % 3);
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    const double level = value * (1.0 - saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255.0 * level));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

}  // namespace scantrove
