#pragma once
#include <algorithm>
#include <cmath>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// The camera scaled down to the resolution at which frames are segmented.
[[nodiscard]] inline Intrinsics scaledDown(const Intrinsics& K, const Intrinsics& working) {
  if (K.width <= working.width) return K;
  const double scale = static_cast<double>(working.width) / K.width;
  return K.resizedTo(working.width, std::max(1, static_cast<int>(std::lround(scale * K.height))));
}

}  // namespace scantrove
