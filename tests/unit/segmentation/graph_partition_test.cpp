#include "core/segmentation/graph_partition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/segmentation/edge_keys.h"
#include "tests/reference/graph_partition_reference.h"
#include "tests/reference/weigh_edges_reference.h"

namespace scantrove {
namespace {

using reference::edgeKey;

struct RandomGraph {
  std::size_t nodes;
  std::vector<reference::GraphEdge> edges;
  std::vector<std::uint16_t> keys;
};

/// A small `distinct` gives many ties. Parallel edges and loops occur.
RandomGraph randomGraph(std::mt19937& random, std::size_t nodes, std::size_t edge_count, int distinct) {
  RandomGraph graph{nodes, {}, {}};
  std::uniform_int_distribution<std::uint32_t> node(0, static_cast<std::uint32_t>(nodes - 1));
  std::uniform_int_distribution<int> step(0, distinct - 1);
  for (std::size_t e = 0; e < edge_count; ++e) {
    const float weight = std::pow(static_cast<float>(step(random)) / static_cast<float>(distinct), 3.0F);
    graph.keys.push_back(edgeKey(weight));
    graph.edges.push_back({node(random), node(random), edgeWeight(graph.keys.back())});
  }
  return graph;
}

std::vector<std::uint32_t> partition(const RandomGraph& graph, float k, std::uint32_t min_size = 0) {
  std::vector<std::uint32_t> counts, order, rejected;
  sortEdges(graph.keys, counts, order);
  GraphPartition components;
  components.reset(graph.nodes, k);
  for (const std::uint32_t e : order) {
    if (!components.join(graph.edges[e].a, graph.edges[e].b, graph.edges[e].weight)) rejected.push_back(e);
  }
  for (const std::uint32_t e : rejected) {
    components.absorb(graph.edges[e].a, graph.edges[e].b, graph.edges[e].weight, min_size);
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < graph.nodes; ++i) result.push_back(components.find(i));
  return result;
}

TEST(EdgeKey, IsMonotonicAndPrecise) {
  std::uint16_t previous = 0;
  for (float weight = 1e-8F; weight <= 4.0F; weight *= 1.0007F) {
    const std::uint16_t key = edgeKey(weight);
    EXPECT_GE(key, previous);
    EXPECT_LT(key, kEdgeKeys);
    if (weight > 2 * EDGE_WEIGHT_FLOOR) {
      EXPECT_LE(edgeWeight(key), weight);
      EXPECT_GE(edgeWeight(key), weight * (1 - 1.0F / 2048));
    }
    previous = key;
  }
  EXPECT_EQ(edgeKey(0), 0);
  EXPECT_EQ(edgeWeight(0), 0.0F);
  EXPECT_EQ(edgeKey(4), kEdgeKeys - 1);
  EXPECT_LT(kEdgeKeys, std::uint32_t{kEdgeNever});
}

TEST(SortEdges, IsStableAndOmitsEdgesThatNeverJoin) {
  const std::vector<std::uint16_t> keys = {7, kEdgeNever, 3, 7, 0, kEdgeNever, 3, 65534};
  std::vector<std::uint32_t> counts, order;
  sortEdges(keys, counts, order);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{4, 2, 6, 0, 3, 7}));
  sortEdges({}, counts, order);
  EXPECT_TRUE(order.empty());
}

TEST(GraphPartition, EqualsTheLiteralAlgorithm_OnRandomGraphs) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t nodes = 1 + random() % 24;
    const std::size_t edges = random() % (3 * nodes + 1);
    const int distinct = trial % 2 == 0 ? 4 : 1000;
    const float k = std::pow(10.0F, -3.0F + 4.0F * static_cast<float>(random() % 1000) / 1000.0F);
    const RandomGraph graph = randomGraph(random, nodes, edges, distinct);
    const reference::LiteralPartition literal(nodes, graph.edges, k);
    ASSERT_EQ(reference::canonical(partition(graph, k)), reference::canonical(literal.components()))
        << "trial " << trial << ", " << nodes << " nodes, " << edges << " edges, k " << k;
  }
}

TEST(GraphPartition, IsNotTooFine) {
  // Between any two neighbouring components there is evidence for a boundary: Dif > MInt (the paper's theorem
  // 1).
  std::mt19937 random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const RandomGraph graph = randomGraph(random, 30, 80, 50);
    const reference::LiteralPartition literal(30, graph.edges, 0.2F);
    ASSERT_EQ(reference::canonical(partition(graph, 0.2F)), reference::canonical(literal.components()));
    for (const reference::GraphEdge& edge : graph.edges) {
      const std::uint32_t a = literal.components()[edge.a], b = literal.components()[edge.b];
      if (a == b) continue;
      EXPECT_GT(literal.difference(a, b), literal.minimumInternal(a, b));
    }
  }
}

TEST(GraphPartition, SmallComponentsJoinTheirMostSimilarNeighbor) {
  // 0-1-2-3 | 4 | 5-6-7-8: node 4 is nearer to the right.
  RandomGraph graph{9, {}, {}};
  const auto edge = [&](std::uint32_t a, std::uint32_t b, float weight) {
    graph.keys.push_back(edgeKey(weight));
    graph.edges.push_back({a, b, edgeWeight(graph.keys.back())});
  };
  for (const std::uint32_t a : {0U, 1U, 2U, 5U, 6U, 7U}) edge(a, a + 1, 0.0F);
  edge(3, 4, 0.9F);
  edge(4, 5, 0.8F);
  EXPECT_EQ(reference::canonical(partition(graph, 0.01F)),
            (std::vector<std::uint32_t>{1, 1, 1, 1, 2, 3, 3, 3, 3}));
  EXPECT_EQ(reference::canonical(partition(graph, 0.01F, 2)),
            (std::vector<std::uint32_t>{1, 1, 1, 1, 2, 2, 2, 2, 2}));
  EXPECT_EQ(reference::canonical(partition(graph, 0.01F, 5)), std::vector<std::uint32_t>(9, 1));
}

TEST(GraphPartition, AbsorptionLeavesNoSmallComponentWithANeighbor) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const RandomGraph graph = randomGraph(random, 200, 400, 1000);
    const std::vector<std::uint32_t> components = partition(graph, 0.01F, 8);
    std::map<std::uint32_t, int> size;
    for (const std::uint32_t c : components) ++size[c];
    for (const reference::GraphEdge& edge : graph.edges) {
      if (components[edge.a] != components[edge.b]) {
        EXPECT_GE(std::min(size[components[edge.a]], size[components[edge.b]]), 8);
      }
    }
  }
}

}  // namespace
}  // namespace scantrove
