#include "core/labeling/overlap_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/labeling/one_row.h"

namespace scantrove {
namespace {

using test::idsOf;
using test::segmentsOf;
using Overlaps = OverlapGraph<RegionId>;

TEST(OverlapGraph, CountsAreasAndOverlaps) {
  const Overlaps graph =
      buildOverlapGraph<RegionId>(segmentsOf({1, 1, 2, 2, 0, 2}), idsOf<RegionId>({7, 7, 7, 9, 9, 0}));
  EXPECT_EQ(graph.patches, idsOf<RegionId>({7, 9}));
  EXPECT_EQ(graph.patch_areas_px, (std::vector<int>{3, 2}));
  ASSERT_EQ(graph.edges.size(), 3U);
  EXPECT_EQ(graph.edges[0].overlap_px, 2);  // 1 - 7
  EXPECT_EQ(graph.edges[1].overlap_px, 1);  // 2 - 7
  EXPECT_EQ(graph.edges[2].overlap_px, 1);  // 2 - 9
}

TEST(OverlapGraph, EdgeQualifies_ByEitherArea) {
  // Segment 1 covers 2 of its 10 pixels with region 3, but that is all of region 3.
  const Overlaps graph = buildOverlapGraph<RegionId>(segmentsOf(std::vector<std::uint32_t>(10, 1)),
                                                     idsOf<RegionId>({3, 3, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(graph.qualifies(graph.edges[0], 0.3F));   // 2 / 2 > 0.3
  EXPECT_FALSE(graph.qualifies(graph.edges[0], 1.0F));  // not more than all
}

TEST(OverlapGraph, SmallSegmentAcrossABorderCoversNeitherSide) {
  // Segment 2 lies half on fragment 1 and half on fragment 2, but is a small part of both.
  std::vector<std::uint32_t> ids(20, 1);
  ids[9] = ids[10] = 2;
  std::vector<FragmentId> projected(20, FragmentId{1});
  std::fill(projected.begin() + 10, projected.end(), FragmentId{2});
  const auto graph = buildOverlapGraph<FragmentId>(segmentsOf(ids), projected);
  ASSERT_EQ(graph.edges.size(), 4U);
  for (const auto& edge : graph.edges) {
    EXPECT_TRUE(graph.qualifies(edge, 0.3F));
    EXPECT_EQ(graph.covers(edge, 0.3F), edge.segment == 1);
  }
}

}  // namespace
}  // namespace scantrove
