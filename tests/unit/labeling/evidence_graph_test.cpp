#include "core/labeling/evidence_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scantrove {
namespace {

std::vector<std::uint32_t> othersOf(const EvidenceGraph& graph, std::uint32_t fragment) {
  std::vector<std::uint32_t> others;
  for (const auto& link : graph.linksOf(FragmentId{fragment})) others.push_back(link.other.value);
  return others;
}

TEST(EvidenceGraph, BorderIsTheSameFromBothSides) {
  EvidenceGraph graph;
  graph.between(FragmentId{5}, FragmentId{2}).observations = 7;
  EXPECT_EQ(graph.between(FragmentId{2}, FragmentId{5}).observations, 7);
  EXPECT_EQ(graph.borderCount(), 1U);
  for (const std::uint32_t fragment : {2U, 5U}) {
    ASSERT_EQ(graph.linksOf(FragmentId{fragment}).size(), 1U);
    EXPECT_EQ(graph.border(graph.linksOf(FragmentId{fragment}).front().border).observations, 7);
  }
}

TEST(EvidenceGraph, LinksAreOrderedByTheOtherFragment) {
  EvidenceGraph graph;
  for (const std::uint32_t other : {9U, 1U, 7U, 3U}) (void)graph.between(FragmentId{4}, FragmentId{other});
  EXPECT_THAT(othersOf(graph, 4), testing::ElementsAre(1, 3, 7, 9));
  EXPECT_THAT(othersOf(graph, 100), testing::IsEmpty());
}

TEST(EvidenceGraph, RemoveDropsOnlyTheBordersOfTheFragment) {
  EvidenceGraph graph;
  graph.between(FragmentId{1}, FragmentId{2}).observations = 1;
  graph.between(FragmentId{2}, FragmentId{3}).observations = 2;
  graph.between(FragmentId{1}, FragmentId{3}).observations = 3;
  graph.remove(FragmentId{2});
  EXPECT_EQ(graph.borderCount(), 1U);
  EXPECT_THAT(othersOf(graph, 1), testing::ElementsAre(3));
  EXPECT_THAT(othersOf(graph, 2), testing::IsEmpty());
  EXPECT_EQ(graph.between(FragmentId{3}, FragmentId{1}).observations, 3);
  // A reused number has no evidence.
  EXPECT_EQ(graph.between(FragmentId{2}, FragmentId{3}).observations, 0);
  EXPECT_EQ(graph.between(FragmentId{2}, FragmentId{1}).observations, 0);
  EXPECT_EQ(graph.borderCount(), 3U);
  graph.remove(FragmentId{50});
  EXPECT_EQ(graph.borderCount(), 3U);
}

TEST(EvidenceGraph, LaterConstraintsHaveHigherOrder) {
  using Constraint = BorderEvidence::Constraint;
  EvidenceGraph graph;
  graph.constrain(FragmentId{1}, FragmentId{2}, Constraint::must_link);
  graph.constrain(FragmentId{3}, FragmentId{2}, Constraint::cannot_link);
  const int first = graph.between(FragmentId{1}, FragmentId{2}).constraint_order;
  EXPECT_GT(graph.between(FragmentId{2}, FragmentId{3}).constraint_order, first);
  graph.constrain(FragmentId{2}, FragmentId{1}, Constraint::cannot_link);
  const BorderEvidence& border = graph.between(FragmentId{1}, FragmentId{2});
  EXPECT_EQ(border.constraint, Constraint::cannot_link);
  EXPECT_GT(border.constraint_order, graph.between(FragmentId{2}, FragmentId{3}).constraint_order);
}

TEST(EvidenceGraph, ProgramNeverReplacesAPersonsConstraint) {
  EvidenceGraph graph;
  graph.constrain(FragmentId{1}, FragmentId{2}, LinkConstraint::cannot_link, true);
  graph.constrain(FragmentId{2}, FragmentId{1}, LinkConstraint::must_link, false);
  EXPECT_EQ(graph.constraintBetween(FragmentId{1}, FragmentId{2}), LinkConstraint::cannot_link);
  graph.constrain(FragmentId{1}, FragmentId{2}, LinkConstraint::none, true);
  graph.constrain(FragmentId{1}, FragmentId{2}, LinkConstraint::must_link, false);
  EXPECT_EQ(graph.constraintBetween(FragmentId{1}, FragmentId{2}), LinkConstraint::must_link);
  EXPECT_EQ(graph.constraintBetween(FragmentId{1}, FragmentId{3}), LinkConstraint::none);
}

TEST(EvidenceGraph, ListsChangedAndRemovedBorders) {
  using Pairs = std::vector<EvidenceGraph::Pair>;
  EvidenceGraph graph;
  graph.between(FragmentId{3}, FragmentId{1}).observations = 2;
  graph.between(FragmentId{3}, FragmentId{4}).observations = 1;
  EXPECT_EQ(graph.takeChanged(), (Pairs{{FragmentId{1}, FragmentId{3}}, {FragmentId{3}, FragmentId{4}}}));
  EXPECT_TRUE(graph.takeChanged().empty());
  graph.remove(FragmentId{4});
  EXPECT_EQ(graph.takeChanged(), (Pairs{{FragmentId{3}, FragmentId{4}}}));
  EXPECT_EQ(graph.find(FragmentId{3}, FragmentId{4}), nullptr);
  EvidenceGraph again;
  again.restore(FragmentId{1}, FragmentId{3}, *graph.find(FragmentId{1}, FragmentId{3}));
  EXPECT_EQ(again.find(FragmentId{3}, FragmentId{1})->observations, 2);
  EXPECT_TRUE(again.takeChanged().empty());
}

}  // namespace
}  // namespace scantrove
