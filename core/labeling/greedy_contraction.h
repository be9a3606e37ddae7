#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace scantrove {

/// An edge of a graph of nodes 0, 1, 2 ...; weights above 0 favour one part, below 0 two.
struct WeightedEdge {
  std::uint32_t a = 0, b = 0;
  float weight = 0;
};

/// Greedy additive edge contraction (Keuper et al. 2015), the standard heuristic of correlation clustering:
/// the two parts with the largest sum of weights between them are merged, until no sum is above 0. All edges
/// between two parts count, so that one weak spot does not join two objects. Ties go to the lower numbers.
/// Returns the part of each node; parts are numbered in the order of their first nodes.
[[nodiscard]] std::vector<std::uint32_t> contractGreedily(std::size_t node_count,
                                                          std::span<const WeightedEdge> edges);

}  // namespace scantrove
