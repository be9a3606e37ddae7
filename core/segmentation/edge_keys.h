#pragma once
#include <bit>
#include <cstdint>

#include "core/segmentation/kernels/edge_layout.h"

namespace scantrove {

inline constexpr std::uint16_t kEdgeNever = EDGE_NEVER;
inline constexpr std::uint32_t kEdgeKeys = EDGE_KEYS;  ///< keys of weights are 0 .. kEdgeKeys - 1

/// The weight that a key stands for: the smallest with that key, within 1/2048 of the original; 0 for the
/// lowest.
[[nodiscard]] inline float edgeWeight(std::uint16_t key) {
  return key == 0 ? 0.0F
                  : std::bit_cast<float>((static_cast<std::uint32_t>(key) << EDGE_KEY_SHIFT) +
                                         EDGE_WEIGHT_FLOOR_BITS);
}

}  // namespace scantrove
