#pragma once
#include <cstdint>
#include <optional>

#include "core/discovery/region_appearance.h"

namespace scantrove {

/// How the regions of an object differ from what a user confirmed.
struct ShapeChange {
  enum class Kind : std::uint8_t { larger, smaller, other_colors };
  Kind kind = Kind::larger;
  float volume = 1;  ///< of the oriented box, now by then; sides below kThinnestSide_m count as that

  bool operator==(const ShapeChange&) const = default;
};

/// Thinner sides are mostly noise (as for sizeDifference).
inline constexpr float kThinnestSide_m = 0.03F;
/// Limits of the volume: changed by more than half. In scans the sides of one thing differ by up to a
/// seventh, which makes 1.5 together; less than half is a part of it.
inline constexpr float kLargerVolume = 1.5F, kSmallerVolume = 0.5F;
/// Least part of the surface that keeps its colour. Views of other sides differ, so single views would call
/// each thing changed that a user walks around; the colours of all its surface do so only if most of it is
/// something else.
inline constexpr float kSameColors = 0.5F;

/// None: it is what was confirmed, as far as both are known. The size goes before the colours.
[[nodiscard]] std::optional<ShapeChange> changeOf(const RegionAppearance& confirmed,
                                                  const RegionAppearance& now);

}  // namespace scantrove
