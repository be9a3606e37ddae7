#include "core/labeling/region_merger.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scantrove {
namespace {

/// One-row images: each number an id.
SegmentMap segmentsOf(const std::vector<std::uint32_t>& ids) {
  SegmentMap map;
  map.width = static_cast<int>(ids.size());
  map.height = 1;
  map.ids = ids;
  map.areas.resize(*std::max_element(ids.begin(), ids.end()) + 1U, 0);
  for (const std::uint32_t id : ids) ++map.areas[id];
  return map;
}

LabelTable tableWith(int labels) {
  LabelTable table;
  for (int i = 0; i < labels; ++i) (void)table.newLabel();
  return table;
}

LabelingParams thesisRule(float threshold = 0.3F) {
  LabelingParams params;
  params.rule = LabelingParams::Rule::thesis;
  params.overlap_threshold = threshold;
  return params;
}

LabelingParams evidenceRule(int frames) {
  LabelingParams params;
  params.rule = LabelingParams::Rule::evidence;
  params.evidence_frames = frames;
  return params;
}

TEST(OverlapGraph, CountsAreasAndOverlaps) {
  const OverlapGraph graph =
      buildOverlapGraph(segmentsOf({1, 1, 2, 2, 0, 2}), std::vector<std::uint32_t>{7, 7, 7, 9, 9, 0});
  EXPECT_EQ(graph.region_ids, (std::vector<std::uint32_t>{7, 9}));
  EXPECT_EQ(graph.region_areas_px, (std::vector<int>{3, 2}));
  ASSERT_EQ(graph.edges.size(), 3U);
  EXPECT_EQ(graph.edges[0].overlap_px, 2);  // 1 - 7
  EXPECT_EQ(graph.edges[1].overlap_px, 1);  // 2 - 7
  EXPECT_EQ(graph.edges[2].overlap_px, 1);  // 2 - 9
}

TEST(OverlapGraph, TheCriterionTakesEitherArea) {
  // Segment 1 covers 2 of its 10 pixels with region 3, but that is all of region 3.
  const OverlapGraph graph = buildOverlapGraph(segmentsOf(std::vector<std::uint32_t>(10, 1)),
                                               std::vector<std::uint32_t>{3, 3, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(graph.qualifies(graph.edges[0], 0.3F));   // 2 / 2 > 0.3
  EXPECT_FALSE(graph.qualifies(graph.edges[0], 1.0F));  // not more than all
}

TEST(OverlapGraph, ASmallSegmentAstrideABorderCoversNeitherSide) {
  // Segment 2 lies half on region 1 and half on region 2, but is a small part of both.
  std::vector<std::uint32_t> ids(20, 1);
  ids[9] = ids[10] = 2;
  std::vector<std::uint32_t> projected(20, 1);
  std::fill(projected.begin() + 10, projected.end(), 2U);
  const OverlapGraph graph = buildOverlapGraph(segmentsOf(ids), projected);
  for (const OverlapGraph::Edge& edge : graph.edges) {
    EXPECT_TRUE(graph.qualifies(edge, 0.3F));
    EXPECT_EQ(graph.covers(edge, 0.3F), edge.segment == 1);
  }
}

TEST(RegionMerger, ASegmentOnUnlabelledGroundGetsANewLabel) {
  LabelTable table;
  RegionMerger merger;
  const auto outcome =
      merger.merge(segmentsOf({1, 1, 2, 0}), std::vector<std::uint32_t>(4, 0), table, thesisRule());
  EXPECT_EQ(outcome.map.labels, (std::vector<std::uint32_t>{1, 1, 2, 0}));
  EXPECT_EQ(outcome.map.regions, outcome.map.labels);
  EXPECT_TRUE(outcome.joined.empty());
}

TEST(RegionMerger, TwoSegmentsOnOneRegionAreThatRegion) {
  LabelTable table = tableWith(5);
  RegionMerger merger;
  const auto outcome =
      merger.merge(segmentsOf({1, 1, 1, 2, 2, 2}), std::vector<std::uint32_t>(6, 5), table, thesisRule());
  EXPECT_EQ(outcome.map.regions, std::vector<std::uint32_t>(6, 5));
}

TEST(RegionMerger, ThesisRuleJoinsWhatOneSegmentCoversIntoTheLargest) {
  LabelTable table = tableWith(4);
  RegionMerger merger;
  const auto outcome = merger.merge(segmentsOf({1, 1, 1, 1, 1}), std::vector<std::uint32_t>{2, 2, 4, 4, 4},
                                    table, thesisRule());
  EXPECT_EQ(outcome.map.regions, std::vector<std::uint32_t>(5, 4));
  EXPECT_EQ(table.regionOf(2), RegionId{4});
  EXPECT_EQ(outcome.joined, (std::vector<std::pair<RegionId, RegionId>>{{RegionId{4}, RegionId{2}}}));
}

TEST(RegionMerger, ThesisRuleFollowsChains) {
  // Regions 1 - 2 share segment 1, regions 2 - 3 share segment 2: all one.
  LabelTable table = tableWith(3);
  RegionMerger merger;
  (void)merger.merge(segmentsOf({1, 1, 1, 2, 2, 2}), std::vector<std::uint32_t>{1, 1, 2, 2, 3, 3}, table,
                     thesisRule());
  EXPECT_EQ(table.regionOf(1), table.regionOf(3));
}

TEST(RegionMerger, PixelsWithoutSegmentKeepTheirRegion) {
  LabelTable table = tableWith(2);
  RegionMerger merger;
  const auto outcome =
      merger.merge(segmentsOf({1, 1, 0}), std::vector<std::uint32_t>{1, 1, 2}, table, thesisRule());
  EXPECT_EQ(outcome.map.regions, (std::vector<std::uint32_t>{1, 1, 2}));
}

TEST(RegionMerger, EvidenceRuleWaitsAndMeanwhileOverwritesNeitherRegion) {
  LabelTable table = tableWith(2);
  RegionMerger merger;
  const SegmentMap bridge = segmentsOf({1, 1, 1, 1, 1, 1});
  const std::vector<std::uint32_t> projected{1, 1, 1, 2, 2, 0};
  for (int frame = 0; frame < 2; ++frame) {
    const auto outcome = merger.merge(bridge, projected, table, evidenceRule(3));
    EXPECT_EQ(outcome.map.regions, (std::vector<std::uint32_t>{1, 1, 1, 2, 2, 1})) << "frame " << frame;
    EXPECT_TRUE(outcome.joined.empty());
  }
  const auto outcome = merger.merge(bridge, projected, table, evidenceRule(3));
  EXPECT_EQ(outcome.map.regions, std::vector<std::uint32_t>(6, 1));
  EXPECT_EQ(outcome.joined, (std::vector<std::pair<RegionId, RegionId>>{{RegionId{1}, RegionId{2}}}));
}

/// Two regions side by side, `height` rows high (they touch along that many pixels), and segments over them.
struct Neighbours {
  static constexpr int kHeight = 12;
  static std::vector<std::uint32_t> rows(const std::vector<std::uint32_t>& row) {
    std::vector<std::uint32_t> image;
    for (int y = 0; y < kHeight; ++y) image.insert(image.end(), row.begin(), row.end());
    return image;
  }
  static SegmentMap segments(const std::vector<std::uint32_t>& row) {
    SegmentMap map = segmentsOf(rows(row));
    map.width = static_cast<int>(row.size());
    map.height = kHeight;
    return map;
  }
  std::vector<std::uint32_t> projected = rows({1, 1, 2, 2});
  SegmentMap bridge = segments({1, 1, 1, 1});
  SegmentMap apart = segments({1, 1, 2, 2});
};

TEST(RegionMerger, SeenApartCountsAgainst) {
  LabelTable table = tableWith(2);
  RegionMerger merger;
  const Neighbours scene;
  for (int round = 0; round < 10; ++round) {
    (void)merger.merge(scene.apart, scene.projected, table, evidenceRule(2));
    (void)merger.merge(scene.bridge, scene.projected, table, evidenceRule(2));
  }
  EXPECT_NE(table.regionOf(1), table.regionOf(2));
}

TEST(RegionMerger, ALongTimeApartOutweighsAShortLeakButNotForEver) {
  LabelTable table = tableWith(2);
  RegionMerger merger;
  const Neighbours scene;
  const LabelingParams params = evidenceRule(3);
  for (int frame = 0; frame < 100; ++frame) (void)merger.merge(scene.apart, scene.projected, table, params);
  // 6 votes against at the most (twice 3), and a lead of 3 for: the ninth frame joins.
  for (int frame = 0; frame < 8; ++frame) (void)merger.merge(scene.bridge, scene.projected, table, params);
  EXPECT_NE(table.regionOf(1), table.regionOf(2));
  (void)merger.merge(scene.bridge, scene.projected, table, params);
  EXPECT_EQ(table.regionOf(1), table.regionOf(2));
}

TEST(RegionMerger, EvidenceFollowsARegionThatWasJoined) {
  LabelTable table = tableWith(3);
  RegionMerger merger;
  const LabelingParams params = evidenceRule(2);
  // Once for the pair 2 - 3, then 1 takes 2 in; once more for (1, was 2) - 3 completes it.
  (void)merger.merge(segmentsOf({1, 1, 1, 1}), std::vector<std::uint32_t>{2, 2, 3, 3}, table, params);
  (void)merger.merge(segmentsOf({1, 1, 1, 1, 1}), std::vector<std::uint32_t>{1, 1, 1, 2, 2}, table, params);
  (void)merger.merge(segmentsOf({1, 1, 1, 1, 1}), std::vector<std::uint32_t>{1, 1, 1, 2, 2}, table, params);
  ASSERT_EQ(table.regionOf(2), RegionId{1});
  ASSERT_NE(table.regionOf(3), RegionId{1});
  (void)merger.merge(segmentsOf({1, 1, 1, 1}), std::vector<std::uint32_t>{2, 2, 3, 3}, table, params);
  EXPECT_EQ(table.regionOf(3), table.regionOf(1));
}

}  // namespace
}  // namespace scantrove
