#pragma once
#include <cstdint>
#include <deque>

namespace scantrove {

/// One point of a labelled cloud: world frame, metres; `label` is the region's id, 0 = unlabelled.
struct LabeledPoint {
  float x = 0, y = 0, z = 0;
  std::uint8_t r = 0, g = 0, b = 0;
  std::uint32_t label = 0;
  std::uint8_t estimated = 0;  ///< 1: on estimated surface, which no depth reading shows

  bool operator==(const LabeledPoint&) const = default;
};

/// The points of a scan in a container that does not copy them as it grows.
using LabeledCloud = std::deque<LabeledPoint>;

}  // namespace scantrove
