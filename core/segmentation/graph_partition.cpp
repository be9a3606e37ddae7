#include "core/segmentation/graph_partition.h"

#include <numeric>

#include "core/segmentation/edge_keys.h"

namespace scantrove {

void GraphPartition::reset(std::size_t node_count, float k) {
  k_ = k;
  parents_.resize(node_count);
  std::iota(parents_.begin(), parents_.end(), 0U);
  roots_.assign(node_count, {1, k});
}

void sortEdges(std::span<const std::uint16_t> keys, std::vector<std::uint32_t>& counts,
               std::vector<std::uint32_t>& order) {
  counts.assign(static_cast<std::size_t>(kEdgeNever) + 1, 0);
  for (const std::uint16_t key : keys) ++counts[key];
  std::uint32_t first = 0;
  for (std::uint32_t& count : counts) first += std::exchange(count, first);
  order.resize(counts[kEdgeNever]);
  for (std::size_t edge = 0; edge < keys.size(); ++edge) {
    if (keys[edge] != kEdgeNever) order[counts[keys[edge]]++] = static_cast<std::uint32_t>(edge);
  }
}

}  // namespace scantrove
