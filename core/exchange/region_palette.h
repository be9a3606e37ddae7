#pragma once
#include <array>
#include <cstdint>

#include "core/base/ids.h"

namespace scantrove {

/// Red, green, blue, each 0..255.
using Rgb = std::array<std::uint8_t, 3>;

/// Colour of a region: the same in the 3D view, in the image panels, in files, and in every run. Neighbouring
/// ids get distant hues (golden-angle steps in OKLCH, all equally vivid). Region 0 ("unlabelled") is a
/// neutral grey.
[[nodiscard]] Rgb regionColor(RegionId region);

/// The same table for segments of a single frame, whose ids are meaningless in other frames.
[[nodiscard]] Rgb segmentColor(SegmentId segment);

}  // namespace scantrove
