#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/segmentation/segment_map.h"

namespace scantrove::test {

/// A one-row segment map of these ids.
inline SegmentMap segmentsOf(const std::vector<std::uint32_t>& ids) {
  SegmentMap map;
  map.width = static_cast<int>(ids.size());
  map.height = 1;
  map.ids = ids;
  map.areas.resize(*std::ranges::max_element(ids) + 1U, 0);
  for (const std::uint32_t id : ids) ++map.areas[id];
  return map;
}

template <class AnyId>
std::vector<AnyId> idsOf(const std::vector<std::uint32_t>& numbers) {
  std::vector<AnyId> ids;
  for (const std::uint32_t number : numbers) ids.push_back(AnyId{number});
  return ids;
}

}  // namespace scantrove::test
