#pragma once
#include <cstdint>
#include <deque>

namespace scantrove {

/// One point of a labelled cloud: world frame, metres; `label` is the region's id, 0 = unlabelled.
struct LabeledPoint {
  float x = 0, y = 0, z = 0;
  std::uint8_t r = 0, g = 0, b = 0;
  std::uint32_t label = 0;

  bool operator==(const LabeledPoint&) const = default;
};

/// As many as a scan has: they are not copied as they become more.
using LabeledCloud = std::deque<LabeledPoint>;

}  // namespace scantrove
