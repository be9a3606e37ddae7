#include "core/labeling/thesis_merger.h"

#include <gtest/gtest.h>

#include "tests/unit/labeling/one_row.h"

namespace scantrove {
namespace {

using test::idsOf;
using test::segmentsOf;

/// Merges one-row images into a table in which fragment i is region i.
class ThesisMergerTest : public testing::Test {
 protected:
  RegionMerger::Outcome merge(const std::vector<std::uint32_t>& segments,
                              const std::vector<std::uint32_t>& projected) {
    while (table_.regions().size() <= *std::ranges::max_element(projected)) (void)table_.newFragment();
    const SegmentMap map = segmentsOf(segments);
    RenderedView view;
    view.fragments = idsOf<FragmentId>(projected);
    return merger_.merge({map, view, {}, {}}, table_, {});
  }
  [[nodiscard]] RegionId regionOf(std::uint32_t fragment) const {
    return table_.regionOf(FragmentId{fragment});
  }

  RegionTable table_;
  ThesisMerger merger_;
};

TEST_F(ThesisMergerTest, StartsAFragment_WhenASegmentOverlapsNone) {
  const auto outcome = merge({1, 1, 2, 0}, {0, 0, 0, 0});
  EXPECT_EQ(outcome.fragments, idsOf<FragmentId>({1, 1, 2, 0}));
  EXPECT_EQ(outcome.regions, idsOf<RegionId>({1, 1, 2, 0}));
  EXPECT_TRUE(outcome.events.joined.empty());
}

TEST_F(ThesisMergerTest, TwoSegmentsTakeTheRegion_WhenBothOverlapIt) {
  EXPECT_EQ(merge({1, 1, 1, 2, 2, 2}, {5, 5, 5, 5, 5, 5}).regions, std::vector(6, RegionId{5}));
}

TEST_F(ThesisMergerTest, JoinsRegionsIntoTheLargest_WhenOneSegmentCoversThem) {
  const auto outcome = merge({1, 1, 1, 1, 1}, {2, 2, 4, 4, 4});
  EXPECT_EQ(outcome.regions, std::vector(5, RegionId{4}));
  EXPECT_EQ(regionOf(2), RegionId{4});
  EXPECT_EQ(outcome.events.joined, (std::vector<std::pair<RegionId, RegionId>>{{RegionId{4}, RegionId{2}}}));
}

TEST_F(ThesisMergerTest, JoinsChainsOfOverlaps) {
  // Regions 1 and 2 share segment 1, regions 2 and 3 segment 2, so all join.
  (void)merge({1, 1, 1, 2, 2, 2}, {1, 1, 2, 2, 3, 3});
  EXPECT_EQ(regionOf(1), regionOf(3));
}

TEST_F(ThesisMergerTest, PixelsWithoutSegmentKeepTheirRegion) {
  EXPECT_EQ(merge({1, 1, 0}, {1, 1, 2}).regions, idsOf<RegionId>({1, 1, 2}));
}

TEST_F(ThesisMergerTest, CountsFragmentsOfOneRegionTogether) {
  (void)merge({1, 1}, {1, 2});
  ASSERT_EQ(regionOf(1), regionOf(2));
  // Neither fragment alone covers more than 0.3 of segment 1 or has more than 0.3 of its pixels in it.
  // Together they cover 4 of 10 pixels.
  const auto outcome = merge({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2},
                             {1, 1, 2, 2, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2});
  EXPECT_EQ(outcome.regions, std::vector(22, regionOf(1)));
  EXPECT_EQ(outcome.fragments[2], FragmentId{2}) << "a voxel of the region keeps its fragment";
}

}  // namespace
}  // namespace scantrove
