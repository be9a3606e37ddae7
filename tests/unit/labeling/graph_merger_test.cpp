#include "core/labeling/graph_merger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/labeling/painted_frame.h"

namespace scantrove {
namespace {

using test::PaintedFrame;
using test::PaintedScan;
using test::Rectangle;
using Constraint = BorderEvidence::Constraint;

constexpr int kMiddle = PaintedFrame::kWidth / 2;
// Points on the two faces.
constexpr int kX = 12, kOtherX = 52, kY = 24;
const std::vector<Rectangle> kClear{PaintedFrame::kLeft, PaintedFrame::kRight};
const std::vector<Rectangle> kLeak{PaintedFrame::kAll};

/// Two faces at nearly a right angle.
PaintedFrame fold() { return PaintedFrame::corner(1.5F); }

bool areOne(const PaintedScan& scan) { return scan.regionAt(kX, kY) == scan.regionAt(kOtherX, kY); }

TEST(GraphMerger, StartsAFragment_WhenASegmentOverlapsNone) {
  PaintedScan scan(fold());
  const auto& outcome = scan.observe(kClear);
  EXPECT_TRUE(outcome.events.joined.empty());
  EXPECT_NE(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY));
  EXPECT_EQ(outcome.regions.front(), scan.regionAt(0, 0));
  EXPECT_FALSE(areOne(scan));
}

TEST(GraphMerger, LeavesPixelsUnlabeled_WhenASegmentIsTooSmall) {
  PaintedScan scan(fold());
  // 120 pixels at 640 x 480 are 1.2 here; the parameter of ten times that: 12.
  scan.params.min_fragment_px = 1200;
  (void)scan.observe({{0, 0, 10, 0}, {0, 10, 11, 10}});
  EXPECT_FALSE(scan.fragmentAt(5, 0));
  EXPECT_TRUE(scan.fragmentAt(5, 10));
}

TEST(GraphMerger, KeepsFacesSeparate_WhenSegmentsSeparateThem) {
  PaintedScan scan(fold());
  scan.observe(kClear, 40);
  EXPECT_FALSE(areOne(scan));
}

TEST(GraphMerger, JoinsAWall_WhenFirstSeenInTwoParts) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.observe(kClear, 2);
  ASSERT_FALSE(areOne(scan));
  const RegionId left = scan.regionAt(kX, kY), right = scan.regionAt(kOtherX, kY);
  RegionEvents all;
  for (int i = 0; i < 20; ++i) {
    const RegionEvents events = scan.observe(kLeak).events;
    all.joined.insert(all.joined.end(), events.joined.begin(), events.joined.end());
  }
  EXPECT_TRUE(areOne(scan));
  ASSERT_EQ(all.joined.size(), 1U);
  EXPECT_THAT((std::array{all.joined[0].first, all.joined[0].second}),
              testing::UnorderedElementsAre(left, right));
}

TEST(GraphMerger, JoinsAcrossAFold_WhenBothAppearedAsOneObject) {
  PaintedScan scan(fold());
  scan.observe(kClear, 20);
  ASSERT_FALSE(areOne(scan));
  scan.appearAs({PaintedFrame::kAll});
  scan.observe(kClear, 10);
  EXPECT_TRUE(areOne(scan));
}

TEST(GraphMerger, SeparatesAnAppearedObject_WhenTheSurfaceIsSmooth) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.observe(kClear, 2);
  scan.appearAs({PaintedFrame::kRight});
  // Every frame shows one smooth surface.
  scan.observe(kLeak, 20);
  EXPECT_FALSE(areOne(scan));
}

TEST(GraphMerger, JudgesTheBorder_WhenTwoObjectsAppearedSeparately) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.observe(kClear, 2);
  scan.appearAs({PaintedFrame::kLeft, PaintedFrame::kRight});
  scan.observe(kLeak, 20);
  EXPECT_TRUE(areOne(scan));
}

/// A wall and the side of a pillar in front of it, with similar colours or without colour. Clearly different
/// colours would not leak.
class LeakTest : public testing::TestWithParam<bool> {
 protected:
  static PaintedFrame surface() {
    PaintedFrame frame = fold();
    if (!GetParam()) return frame;
    frame.color_lab.assign(PaintedFrame::kPixels, {60, 5, 5});
    PaintedFrame::fill(frame.color_lab, PaintedFrame::kRight, Eigen::Vector3f(60, 5, 7));
    return frame;
  }
};
const std::vector<Rectangle> kClearSide{PaintedFrame::kLeft, {kMiddle, 0, 47, PaintedFrame::kHeight - 1}};
const std::vector<Rectangle> kLeakingSide{{0, 0, 47, PaintedFrame::kHeight - 1}};
constexpr int kSideX = 42;

TEST_P(LeakTest, IsSplit_WhenClearFramesFollow) {
  PaintedScan scan(surface());
  const auto areOne = [&] { return scan.regionAt(kX, kY) == scan.regionAt(kSideX, kY); };
  scan.observe(kClearSide, 3);
  const RegionId left = scan.regionAt(kX, kY), right = scan.regionAt(kSideX, kY);
  scan.observe(kLeakingSide, 10);
  // If ten leaking frames do not join the regions, more follow.
  for (int frame = 0; frame < 50 && !areOne(); ++frame) scan.observe(kLeakingSide);
  ASSERT_TRUE(areOne()) << "no leak formed";
  int frames = 0;
  RegionEvents events;
  while (areOne() && frames < 30) {
    events = scan.observe(kClearSide).events;
    ++frames;
  }
  ASSERT_FALSE(areOne());
  ASSERT_EQ(events.parted.size(), 1U);
  const RegionId remaining = events.parted.front().first;
  EXPECT_TRUE(remaining == left || remaining == right);
  EXPECT_NE(events.parted.front().second, left);
  EXPECT_NE(events.parted.front().second, right);
  scan.observe(kClearSide, 30);
  EXPECT_FALSE(areOne());
  for (int y = 0; y < PaintedFrame::kHeight; ++y) {
    EXPECT_EQ(scan.regionAt(kMiddle - 1, y), scan.regionAt(kX, kY));
    EXPECT_EQ(scan.regionAt(kMiddle, y), scan.regionAt(kSideX, kY));
  }
}

INSTANTIATE_TEST_SUITE_P(GraphMerger, LeakTest, testing::Values(false, true), [](const auto& is_colored) {
  return is_colored.param ? "InTwoColors" : "WithoutColor";
});

TEST(GraphMerger, SplitsAFragmentThenItsRegion_WhenItCoversTwoFaces) {
  PaintedScan scan(fold());
  scan.observe(kLeak, 10);
  ASSERT_EQ(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY));
  const RegionId region = scan.regionAt(kX, kY);
  const FragmentId original = scan.fragmentAt(kX, kY);
  const std::vector<Rectangle> smaller_right{PaintedFrame::kLeft,
                                             {kMiddle, 0, 55, PaintedFrame::kHeight - 1}};
  RegionMerger::Outcome outcome;
  for (int i = 0; i < 30 && outcome.split_off.empty(); ++i) outcome = scan.observe(smaller_right);
  ASSERT_EQ(outcome.split_off.size(), 1U);
  EXPECT_EQ(outcome.split_from, std::vector{original});
  EXPECT_EQ(scan.fragmentAt(kOtherX, kY), outcome.split_off.front()) << "its voxels change at once";
  EXPECT_THAT(outcome.events.parted, testing::IsEmpty()) << "a split fragment stays in its region";
  EXPECT_EQ(scan.regionAt(kOtherX, kY), region);
  for (int i = 0; i < 10 && outcome.events.parted.empty(); ++i) outcome = scan.observe(smaller_right);
  EXPECT_EQ(outcome.events.parted,
            (std::vector<std::pair<RegionId, RegionId>>{{region, scan.regionAt(kOtherX, kY)}}));
  scan.observe(smaller_right, 30);
  EXPECT_FALSE(areOne(scan));
  EXPECT_EQ(scan.regionAt(kX, kY), region) << "the larger side keeps the region";
}

TEST(GraphMerger, KeepsAWallTogether_WhenSegmentsSometimesCutIt) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.observe(kLeak, 20);
  for (const int cut : {12, 20, 28, 36, 44, 52}) {
    const std::vector<Rectangle> in_two{{0, 0, cut, PaintedFrame::kHeight - 1},
                                        {cut + 1, 0, PaintedFrame::kWidth - 1, PaintedFrame::kHeight - 1}};
    // As many frames as split a fragment, then frames with one segment.
    for (int i = 0; i < 10; ++i) {
      const RegionEvents events = scan.observe(i < FragmentSplitter::kObservations ? in_two : kLeak).events;
      EXPECT_THAT(events.parted, testing::IsEmpty()) << "cut at " << cut << ", frame " << i;
      EXPECT_THAT(events.joined, testing::IsEmpty()) << "cut at " << cut << ", frame " << i;
    }
  }
  EXPECT_TRUE(areOne(scan));
}

TEST(GraphMerger, MustLinkOverridesEvidence) {
  PaintedScan scan(fold());
  scan.observe(kClear, 20);
  ASSERT_FALSE(areOne(scan));
  scan.merger.constrain(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY), Constraint::must_link);
  for (int i = 0; i < 40; ++i) {
    scan.observe(kClear);
    EXPECT_TRUE(areOne(scan)) << "frame " << i;
  }
}

TEST(GraphMerger, CannotLinkOverridesEvidence) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.observe(kClear, 2);
  scan.merger.constrain(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY), Constraint::cannot_link);
  for (int i = 0; i < 40; ++i) {
    scan.observe(kLeak);
    EXPECT_FALSE(areOne(scan)) << "frame " << i;
  }
}

TEST(GraphMerger, NewerConstraintWins) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.observe(kClear, 2);
  const FragmentId left = scan.fragmentAt(kX, kY), right = scan.fragmentAt(kOtherX, kY);
  for (const bool as_one : {true, false, true, false}) {
    scan.merger.constrain(left, right, as_one ? Constraint::must_link : Constraint::cannot_link);
    scan.observe(kClear);
    EXPECT_EQ(areOne(scan), as_one);
  }
}

TEST(GraphMerger, JoiningOddsFollowTheEvidenceOfBorders) {
  PaintedScan scan(fold());
  scan.observe(kClear, 20);
  const auto odds = [&] {
    return scan.merger.joiningOdds(scan.regionAt(kX, kY), scan.regionAt(kOtherX, kY), scan.table, {},
                                   scan.params);
  };
  ASSERT_TRUE(odds());
  EXPECT_LT(*odds(), 0) << "two faces, always segmented separately";
  const float before = *odds();
  scan.observe(kLeak, 3);
  ASSERT_FALSE(areOne(scan));
  EXPECT_GT(*odds(), before) << "some frames had one segment";
  EXPECT_FALSE(scan.merger.joiningOdds(scan.regionAt(kX, kY), RegionId{999}, scan.table, {}, scan.params));
  scan.merger.constrain(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY), Constraint::cannot_link);
  EXPECT_FALSE(odds());
}

TEST(GraphMerger, JoinsRegions_WithTheFrameAfterMustBeOne) {
  PaintedScan scan(fold());
  scan.observe(kClear, 20);
  scan.merger.mustBeOne(scan.regionAt(kX, kY), scan.regionAt(kOtherX, kY), scan.table);
  EXPECT_FALSE(areOne(scan));
  for (int i = 0; i < 40; ++i) {
    scan.observe(kClear);
    EXPECT_TRUE(areOne(scan)) << "frame " << i;
  }
}

TEST(GraphMerger, RepairsAnOutline_WhenClearFramesFollow) {
  // The right fragment extends eight pixels onto the left face; clear frames correct that.
  PaintedScan scan(fold());
  scan.observe(
      {{0, 0, kMiddle - 9, PaintedFrame::kHeight - 1}, {kMiddle - 8, 0, 63, PaintedFrame::kHeight - 1}}, 3);
  ASSERT_EQ(scan.fragmentAt(kMiddle - 4, kY), scan.fragmentAt(kOtherX, kY));
  scan.observe(kClear, 30);
  EXPECT_EQ(scan.regionAt(kMiddle - 4, kY), scan.regionAt(kX, kY));
  EXPECT_NE(scan.regionAt(kMiddle - 4, kY), scan.regionAt(kOtherX, kY));
}

TEST(GraphMerger, KeepsAFragment_WhenASegmentCoversIt) {
  // A segment that covers a smaller fragment does not relabel its pixels.
  PaintedScan scan(fold());
  const Rectangle object{kMiddle + 10, 10, kMiddle + 20, 30};
  scan.observe({PaintedFrame::kLeft, PaintedFrame::kRight, object}, 3);
  const FragmentId fragment = scan.fragmentAt(kMiddle + 15, 20);
  scan.observe(kClear, 40);
  EXPECT_EQ(scan.fragmentAt(kMiddle + 15, 20), fragment);
}

TEST(GraphMerger, RemovesEvidence_WhenAFragmentIsForgotten) {
  PaintedScan scan(fold());
  scan.observe(kClear, 5);
  const FragmentId right = scan.fragmentAt(kOtherX, kY);
  ASSERT_EQ(scan.merger.graph().borderCount(), 1U);
  scan.merger.forget(right);
  EXPECT_EQ(scan.merger.graph().borderCount(), 0U);
}

TEST(GraphMerger, IsDeterministic) {
  const auto scanOnce = [] {
    std::mt19937 random(7);
    PaintedScan scan(fold());
    std::vector<RegionId> seen;
    for (int i = 0; i < 60; ++i) {
      std::vector<Rectangle> segments;
      for (int n = 0; n < 8; ++n) {
        const int x = static_cast<int>(random() % 48), y = static_cast<int>(random() % 36);
        segments.push_back({x, y, x + static_cast<int>(random() % 16), y + static_cast<int>(random() % 12)});
      }
      const auto& outcome = scan.observe(segments);
      seen.insert(seen.end(), outcome.regions.begin(), outcome.regions.end());
    }
    EXPECT_GT(scan.merger.graph().borderCount(), 10U);
    return seen;
  };
  EXPECT_EQ(scanOnce(), scanOnce());
}

}  // namespace
}  // namespace scantrove
