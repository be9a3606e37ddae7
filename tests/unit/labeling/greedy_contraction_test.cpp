#include "core/labeling/greedy_contraction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace scantrove {
namespace {

using testing::ElementsAre;

/// The definition: recomputes all sums for each contraction.
std::vector<std::uint32_t> contractLiterally(std::size_t node_count, const std::vector<WeightedEdge>& edges) {
  std::vector<std::uint32_t> part(node_count);  // numbered by its first node
  for (std::uint32_t node = 0; node < node_count; ++node) part[node] = node;
  for (;;) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> sums;
    for (const WeightedEdge& edge : edges) {
      if (part[edge.a] == part[edge.b]) continue;
      sums[std::minmax(part[edge.a], part[edge.b])] += static_cast<double>(edge.weight);
    }
    double largest = 0;
    std::pair<std::uint32_t, std::uint32_t> best;
    for (const auto& [pair, sum] : sums) {
      if (sum > largest) std::tie(largest, best) = std::pair(sum, pair);
    }
    if (largest == 0) break;
    std::ranges::replace(part, best.second, best.first);
  }
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t& node_part : part)
    node_part = number.try_emplace(node_part, static_cast<std::uint32_t>(number.size())).first->second;
  return part;
}

/// Integer weights give exact sums and many ties.
std::vector<WeightedEdge> randomEdges(std::mt19937& random, std::uint32_t nodes, int count) {
  std::vector<WeightedEdge> edges;
  for (int i = 0; i < count; ++i) {
    edges.push_back({static_cast<std::uint32_t>(random() % nodes),
                     static_cast<std::uint32_t>(random() % nodes), static_cast<float>(random() % 9) - 4});
  }
  return edges;
}

TEST(ContractGreedily, EqualsTheDefinition_OnRandomGraphs) {
  std::mt19937 random(11);
  std::size_t parts_seen = 0;
  for (int round = 0; round < 400; ++round) {
    const auto nodes = static_cast<std::uint32_t>(2 + random() % 14);
    const auto edges = randomEdges(random, nodes, static_cast<int>(random() % 40));
    const auto parts = contractGreedily(nodes, edges);
    ASSERT_EQ(parts, contractLiterally(nodes, edges)) << "round " << round;
    parts_seen += *std::ranges::max_element(parts);
  }
  EXPECT_GT(parts_seen, 400U) << "graphs that all become one part would prove nothing";
}

TEST(ContractGreedily, GivesEqualParts_InAnyOrderOfEdges) {
  std::mt19937 random(12);
  for (int round = 0; round < 50; ++round) {
    auto edges = randomEdges(random, 12, 30);
    const auto parts = contractGreedily(12, edges);
    std::ranges::shuffle(edges, random);
    for (WeightedEdge& edge : edges) {
      if (random() % 2 == 0) std::swap(edge.a, edge.b);
    }
    EXPECT_EQ(contractGreedily(12, edges), parts);
  }
}

TEST(ContractGreedily, DoesNotChain_AgainstANegativeEdge) {
  EXPECT_THAT(contractGreedily(3, std::vector<WeightedEdge>{{0, 1, 3}, {1, 2, 2}, {0, 2, -9}}),
              ElementsAre(0, 0, 1));
  EXPECT_THAT(contractGreedily(3, std::vector<WeightedEdge>{{0, 1, 3}, {1, 2, 2}, {0, 2, -1}}),
              ElementsAre(0, 0, 0));
}

TEST(ContractGreedily, NumbersPartsByTheirFirstNode) {
  EXPECT_THAT(contractGreedily(5, std::vector<WeightedEdge>{{1, 4, 1}, {2, 3, 1}}),
              ElementsAre(0, 1, 2, 2, 1));
}

TEST(ContractGreedily, DoesNotJoin_WhenTheSumIsZero) {
  EXPECT_THAT(contractGreedily(2, std::vector<WeightedEdge>{{0, 1, 0}}), ElementsAre(0, 1));
  EXPECT_THAT(contractGreedily(2, std::vector<WeightedEdge>{{0, 1, 2}, {1, 0, -2}, {1, 1, 5}}),
              ElementsAre(0, 1));
  EXPECT_TRUE(contractGreedily(0, {}).empty());
}

}  // namespace
}  // namespace scantrove
