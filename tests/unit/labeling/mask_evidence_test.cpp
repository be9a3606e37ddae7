#include "core/labeling/mask_evidence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/labeling/painted_frame.h"
#include "tests/unit/labeling/painted_masks.h"

namespace scantrove::test {
namespace {

using testing::IsEmpty;

constexpr RegionId kLeftRegion{9}, kRightRegion{4};
constexpr MaskEvidence::Border kBorderOfHalves{kRightRegion, kLeftRegion};

/// The left and the right half of the surface are one region each.
RenderedView halvesOf(PaintedFrame frame) {
  return withRegions(frame, {{PaintedFrame::kLeft, kLeftRegion}, {PaintedFrame::kRight, kRightRegion}});
}

MaskVotes votesOf(const RenderedView& view, const std::vector<PixelMask>& masks) {
  MaskEvidence evidence;
  evidence.add(view, masks);
  const auto found = evidence.borders().find(kBorderOfHalves);
  return found == evidence.borders().end() ? MaskVotes{} : found->second;
}

TEST(MaskEvidence, MaskThatHoldsBothRegionsIsAVoteTogether) {
  EXPECT_EQ(votesOf(halvesOf(PaintedFrame::corner(0)), {maskOf(PaintedFrame::kAll)}), (MaskVotes{1, 0}));
}

TEST(MaskEvidence, MaskThatHoldsOneRegionIsAVoteApart) {
  const RenderedView view = halvesOf(PaintedFrame::corner(0));
  EXPECT_EQ(votesOf(view, {maskOf(PaintedFrame::kLeft)}), (MaskVotes{0, 1}));
  EXPECT_EQ(votesOf(view, {maskOf(PaintedFrame::kRight)}), (MaskVotes{0, 1}));
  EXPECT_EQ(votesOf(view, {maskOf(PaintedFrame::kLeft), maskOf(PaintedFrame::kRight)}), (MaskVotes{0, 1}))
      << "a frame has one vote";
}

TEST(MaskEvidence, OutlinesMayDifferFromThoseOfTheMap) {
  const RenderedView view = halvesOf(PaintedFrame::corner(0));
  // 26 of 32 columns are 81 %, 6 of 32 are 19 %.
  EXPECT_EQ(votesOf(view, {maskOf({6, 0, 57, 47})}), (MaskVotes{1, 0}));
  EXPECT_EQ(votesOf(view, {maskOf({0, 0, 37, 47})}), (MaskVotes{0, 1}));
}

TEST(MaskEvidence, MaskThatCoversHalfOfARegionSaysNothing) {
  const RenderedView view = halvesOf(PaintedFrame::corner(0));
  EXPECT_EQ(votesOf(view, {maskOf({0, 0, 47, 47})}), MaskVotes{});
  EXPECT_EQ(votesOf(view, {maskOf({16, 0, 47, 47})}), MaskVotes{});
  EXPECT_EQ(votesOf(view, {}), MaskVotes{});
}

TEST(MaskEvidence, FrameSaysNothing_WhenItsMasksContradict) {
  EXPECT_EQ(
      votesOf(halvesOf(PaintedFrame::corner(0)), {maskOf(PaintedFrame::kAll), maskOf(PaintedFrame::kLeft)}),
      MaskVotes{});
}

TEST(MaskEvidence, CountsFrames) {
  const RenderedView view = halvesOf(PaintedFrame::corner(0));
  MaskEvidence evidence;
  for (int frame = 0; frame < 3; ++frame)
    evidence.add(view, std::vector<PixelMask>{maskOf(PaintedFrame::kAll)});
  evidence.add(view, std::vector<PixelMask>{maskOf(PaintedFrame::kLeft)});
  ASSERT_EQ(evidence.borders().size(), 1U);
  EXPECT_EQ(evidence.borders().at(kBorderOfHalves), (MaskVotes{3, 1}));
}

TEST(MaskEvidence, RegionsHaveNoBorder_WhenOneOccludesTheOther) {
  MaskEvidence evidence;
  evidence.add(halvesOf(PaintedFrame::step(0.3F)), std::vector<PixelMask>{maskOf(PaintedFrame::kAll)});
  EXPECT_THAT(evidence.borders(), IsEmpty());
}

TEST(MaskEvidence, UnlabelledGapsOfTwoPixelsAreBridged) {
  for (const auto& [gap_px, votes] : {std::pair(2, MaskVotes{1, 0}), std::pair(3, MaskVotes{})}) {
    RenderedView view = halvesOf(PaintedFrame::corner(0));
    PaintedFrame::fill(view.regions, {32, 0, 31 + gap_px, 47}, RegionId{});
    EXPECT_EQ(votesOf(view, {maskOf(PaintedFrame::kAll)}), votes) << gap_px;
  }
}

TEST(MaskCoverage, CountsThePixelsOfEachRegion) {
  const RenderedView view = halvesOf(PaintedFrame::corner(0));
  const MaskCoverage coverage = coverageOf(view, std::vector<PixelMask>{maskOf({0, 0, 39, 47}), PixelMask{}});
  EXPECT_THAT(coverage.regions, testing::ElementsAre(kRightRegion, kLeftRegion));
  EXPECT_THAT(coverage.areas_px, testing::ElementsAre(32 * 48, 32 * 48));
  EXPECT_EQ(coverage.part(0, 0), 0.25F) << "8 of 32 columns";
  EXPECT_EQ(coverage.part(0, 1), 1);
  EXPECT_EQ(coverage.part(1, 0), 0);
}

}  // namespace
}  // namespace scantrove::test
