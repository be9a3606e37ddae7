#include "core/collection/shape_change.h"

namespace scantrove {
namespace {

float volumeOf(const RegionAppearance& appearance) {
  return appearance.size_m.cwiseMax(kThinnestSide_m).prod();
}

}  // namespace

std::optional<ShapeChange> changeOf(const RegionAppearance& confirmed, const RegionAppearance& now) {
  if (!(confirmed.size_m.norm() > 0) || !(now.size_m.norm() > 0)) return std::nullopt;
  const float volume = volumeOf(now) / volumeOf(confirmed);
  if (volume > kLargerVolume) return ShapeChange{ShapeChange::Kind::larger, volume};
  if (volume < kSmallerVolume) return ShapeChange{ShapeChange::Kind::smaller, volume};
  const bool have_colors = !confirmed.colors.isEmpty() && !now.colors.isEmpty();
  if (have_colors && confirmed.colors.intersection(now.colors) < kSameColors)
    return ShapeChange{ShapeChange::Kind::other_colors, volume};
  return std::nullopt;
}

}  // namespace scantrove
