#pragma once
#include "core/exchange/region_palette.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// Colour of a tracking state in the 3D view and in the status line.
[[nodiscard]] constexpr Rgb trackingColor(TrackingState state) {
  switch (state) {
    case TrackingState::tracking:
      return {47, 179, 113};
    case TrackingState::uncertain:
      return {232, 163, 23};
    case TrackingState::lost:
      return {229, 72, 77};
    case TrackingState::relocalized:
      return {62, 146, 230};
  }
  return {128, 128, 128};
}

}  // namespace scantrove
