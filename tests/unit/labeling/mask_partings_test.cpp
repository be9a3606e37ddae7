#include "core/labeling/mask_partings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/labeling/painted_masks.h"

namespace scantrove::test {
namespace {

using testing::IsEmpty;

constexpr RegionId kWhole{3}, kInFront{8};

/// One region over the whole surface.
RenderedView wholeWall() { return withRegions(PaintedFrame::corner(0), {{PaintedFrame::kAll, kWhole}}); }

/// Partings by the left half in the first frame, counted in frames with these masks.
MaskVotes votesAfter(const std::vector<std::vector<PixelMask>>& frames) {
  MaskPartings partings;
  partings.find(wholeWall(), std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  for (const std::vector<PixelMask>& masks : frames) partings.count(wholeWall(), masks);
  const std::vector<MaskParting> best = partings.best();
  EXPECT_EQ(best.size(), 1U);
  return best.empty() ? MaskVotes{} : best.front().votes;
}

TEST(MaskPartings, OutlineOfAMaskHasPointsOnBothSides) {
  MaskPartings partings;
  partings.find(wholeWall(), std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  ASSERT_EQ(partings.best().size(), 1U);
  const MaskParting parting = partings.best().front();
  EXPECT_EQ(parting.region, kWhole);
  EXPECT_EQ(parting.votes, MaskVotes{}) << "nothing was counted yet";
  ASSERT_GE(parting.here_world.size(), 6U);
  ASSERT_GE(parting.there_world.size(), 6U);
  // The outline is at x = 0; a pixel is 1 / 60 m wide, and points keep a distance of some pixels.
  for (const Eigen::Vector3f& point : parting.here_world) EXPECT_LT(point.x(), -0.1F);
  for (const Eigen::Vector3f& point : parting.there_world) EXPECT_GT(point.x(), 0.1F);
  float lowest = 1, highest = -1;
  for (const Eigen::Vector3f& point : parting.here_world) {
    lowest = std::min(lowest, point.y());
    highest = std::max(highest, point.y());
  }
  EXPECT_GT(highest - lowest, 0.2F) << "points are spread over a side";
}

TEST(MaskPartings, FrameThatPartsThePointsIsAVoteApart) {
  EXPECT_EQ(votesAfter({{maskOf(PaintedFrame::kLeft)}}), (MaskVotes{0, 1}));
  EXPECT_EQ(votesAfter({{maskOf(PaintedFrame::kRight)}}), (MaskVotes{0, 1})) << "either side may be the mask";
  EXPECT_EQ(votesAfter({{maskOf({0, 0, 25, 47})}, {maskOf({0, 0, 37, 47})}}), (MaskVotes{0, 2}))
      << "with an outline some pixels away";
}

TEST(MaskPartings, FrameThatHoldsThePointsInOneMaskIsAVoteTogether) {
  EXPECT_EQ(votesAfter({{maskOf(PaintedFrame::kAll)}}), (MaskVotes{1, 0}));
}

TEST(MaskPartings, FrameSaysNothing_WhenNoMaskHoldsASideOrMasksContradict) {
  EXPECT_EQ(votesAfter({{}}), MaskVotes{});
  EXPECT_EQ(votesAfter({{maskOf({0, 0, 63, 23})}}), MaskVotes{}) << "another way to part the region";
  EXPECT_EQ(votesAfter({{maskOf(PaintedFrame::kAll), maskOf(PaintedFrame::kLeft)}}), MaskVotes{});
}

TEST(MaskPartings, FrameSaysNothing_WhenASideIsHidden) {
  MaskPartings partings;
  partings.find(wholeWall(), std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  const RenderedView hidden =
      withRegions(PaintedFrame::corner(0), {{PaintedFrame::kLeft, kWhole}, {PaintedFrame::kRight, kInFront}});
  partings.count(hidden, std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  EXPECT_EQ(partings.best().front().votes, MaskVotes{});
  // The right half 0.3 m behind is another surface.
  const RenderedView behind = withRegions(PaintedFrame::step(0.3F), {{PaintedFrame::kAll, kWhole}});
  partings.count(behind, std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  EXPECT_EQ(partings.best().front().votes, MaskVotes{});
}

TEST(MaskPartings, MaskPartsNothing_WhenItCoversAllOrAStripOfTheRegion) {
  MaskPartings partings;
  partings.find(wholeWall(),
                std::vector<PixelMask>{maskOf(PaintedFrame::kAll), maskOf({0, 0, 3, 47}), PixelMask{}});
  EXPECT_THAT(partings.best(), IsEmpty()) << "4 of 64 columns are 6 %";
}

TEST(MaskPartings, EstimatedSurfaceIsNoSide) {
  RenderedView view = wholeWall();
  view.is_estimated.assign(PaintedFrame::kPixels, 0);
  PaintedFrame::fill(view.is_estimated, PaintedFrame::kRight, std::uint8_t{1});
  MaskPartings partings;
  partings.find(view, std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  EXPECT_THAT(partings.best(), IsEmpty());
}

// The first frame's mask is an outlier: the upper half. Five frames part the region into left and right.
TEST(MaskPartings, BestPartingIsTheOneThatMostFramesShow) {
  MaskPartings partings;
  std::vector<std::vector<PixelMask>> frames(6, {maskOf(PaintedFrame::kLeft)});
  frames.front() = {maskOf({0, 0, 63, 23})};
  for (const std::vector<PixelMask>& masks : frames) partings.find(wholeWall(), masks);
  for (const std::vector<PixelMask>& masks : frames) partings.count(wholeWall(), masks);
  ASSERT_EQ(partings.best().size(), 1U);
  EXPECT_EQ(partings.best().front().votes, (MaskVotes{0, 5}));
  EXPECT_LT(partings.best().front().here_world.front().x(), 0);
}

}  // namespace
}  // namespace scantrove::test
