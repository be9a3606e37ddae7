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
// Points on the two sides.
constexpr int kX = 12, kOtherX = 52, kY = 24;
const std::vector<Rectangle> kClear{PaintedFrame::kLeft, PaintedFrame::kRight};
const std::vector<Rectangle> kLeak{PaintedFrame::kAll};

/// Wall and floor, so to say: two faces in a right angle.
PaintedFrame fold() { return PaintedFrame::corner(1.5F); }

bool areOne(const PaintedScan& scan) { return scan.regionAt(kX, kY) == scan.regionAt(kOtherX, kY); }

TEST(GraphMerger, StartsAFragment_WhenASegmentOverlapsNone) {
  PaintedScan scan(fold());
  const auto& outcome = scan.look(kClear);
  EXPECT_TRUE(outcome.events.joined.empty());
  EXPECT_NE(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY));
  EXPECT_EQ(outcome.regions.front(), scan.regionAt(0, 0));
  EXPECT_FALSE(areOne(scan));
}

TEST(GraphMerger, LeavesPixelsUnlabeled_WhenASegmentIsTooSmall) {
  PaintedScan scan(fold());
  // 120 pixels at 640 x 480 are 1.2 here; the parameter of ten times that: 12.
  scan.params.min_fragment_px = 1200;
  (void)scan.look({{0, 0, 10, 0}, {0, 10, 11, 10}});
  EXPECT_FALSE(scan.fragmentAt(5, 0));
  EXPECT_TRUE(scan.fragmentAt(5, 10));
}

TEST(GraphMerger, KeepsFacesSeparate_WhenSegmentsSeparateThem) {
  PaintedScan scan(fold());
  scan.look(kClear, 40);
  EXPECT_FALSE(areOne(scan));
}

TEST(GraphMerger, JoinsAWall_WhenFirstSeenInTwoParts) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.look(kClear, 2);
  ASSERT_FALSE(areOne(scan));
  const RegionId left = scan.regionAt(kX, kY), right = scan.regionAt(kOtherX, kY);
  RegionEvents all;
  for (int i = 0; i < 20; ++i) {
    const RegionEvents events = scan.look(kLeak).events;
    all.joined.insert(all.joined.end(), events.joined.begin(), events.joined.end());
  }
  EXPECT_TRUE(areOne(scan));
  ASSERT_EQ(all.joined.size(), 1U);
  EXPECT_THAT((std::array{all.joined[0].first, all.joined[0].second}),
              testing::UnorderedElementsAre(left, right));
}

TEST(GraphMerger, JoinsAcrossAFold_WhenBothAppearedAsOneObject) {
  PaintedScan scan(fold());
  scan.look(kClear, 20);
  ASSERT_FALSE(areOne(scan));
  scan.appearAs({PaintedFrame::kAll});
  scan.look(kClear, 10);
  EXPECT_TRUE(areOne(scan));
}

TEST(GraphMerger, SeparatesAnAppearedObject_WhenTheSurfaceIsSmooth) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.look(kClear, 2);
  scan.appearAs({PaintedFrame::kRight});
  // Every frame sees one smooth surface.
  scan.look(kLeak, 20);
  EXPECT_FALSE(areOne(scan));
}

TEST(GraphMerger, JudgesTheBorder_WhenTwoObjectsAppearedSeparately) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.look(kClear, 2);
  scan.appearAs({PaintedFrame::kLeft, PaintedFrame::kRight});
  scan.look(kLeak, 20);
  EXPECT_TRUE(areOne(scan));
}

/// A wall and the side of a pillar before it, which differ little in colour, or without any; what differs
/// much does not leak.
class ALeak : public testing::TestWithParam<bool> {
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

TEST_P(ALeak, IsSplit_WhenClearFramesFollow) {
  PaintedScan scan(surface());
  const auto areOne = [&] { return scan.regionAt(kX, kY) == scan.regionAt(kSideX, kY); };
  scan.look(kClearSide, 3);
  const RegionId left = scan.regionAt(kX, kY), right = scan.regionAt(kSideX, kY);
  scan.look(kLeakingSide, 10);
  // Where ten frames that are wrong make no leak, more of them.
  for (int frame = 0; frame < 50 && !areOne(); ++frame) scan.look(kLeakingSide);
  ASSERT_TRUE(areOne()) << "there is nothing to heal";
  int frames = 0;
  RegionEvents events;
  while (areOne() && frames < 30) {
    events = scan.look(kClearSide).events;
    ++frames;
  }
  ASSERT_FALSE(areOne());
  ASSERT_EQ(events.parted.size(), 1U);
  const RegionId kept = events.parted.front().first;
  EXPECT_TRUE(kept == left || kept == right);
  EXPECT_NE(events.parted.front().second, left);
  EXPECT_NE(events.parted.front().second, right);
  scan.look(kClearSide, 30);
  EXPECT_FALSE(areOne());
  for (int y = 0; y < PaintedFrame::kHeight; ++y) {
    EXPECT_EQ(scan.regionAt(kMiddle - 1, y), scan.regionAt(kX, kY));
    EXPECT_EQ(scan.regionAt(kMiddle, y), scan.regionAt(kSideX, kY));
  }
}

INSTANTIATE_TEST_SUITE_P(GraphMerger, ALeak, testing::Values(false, true), [](const auto& is_colored) {
  return is_colored.param ? "InTwoColors" : "WithoutColor";
});

TEST(GraphMerger, SplitsAFragmentThenItsRegion_WhenItCoversTwoFaces) {
  PaintedScan scan(fold());
  scan.look(kLeak, 10);
  ASSERT_EQ(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY));
  const RegionId whole = scan.regionAt(kX, kY);
  const FragmentId born = scan.fragmentAt(kX, kY);
  const std::vector<Rectangle> smaller_right{PaintedFrame::kLeft,
                                             {kMiddle, 0, 55, PaintedFrame::kHeight - 1}};
  RegionMerger::Outcome outcome;
  for (int i = 0; i < 30 && outcome.split_off.empty(); ++i) outcome = scan.look(smaller_right);
  ASSERT_EQ(outcome.split_off.size(), 1U);
  EXPECT_EQ(outcome.split_from, std::vector{born});
  EXPECT_EQ(scan.fragmentAt(kOtherX, kY), outcome.split_off.front()) << "its voxels change at once";
  EXPECT_THAT(outcome.events.parted, testing::IsEmpty()) << "a cut alone parts nothing";
  EXPECT_EQ(scan.regionAt(kOtherX, kY), whole);
  for (int i = 0; i < 10 && outcome.events.parted.empty(); ++i) outcome = scan.look(smaller_right);
  EXPECT_EQ(outcome.events.parted,
            (std::vector<std::pair<RegionId, RegionId>>{{whole, scan.regionAt(kOtherX, kY)}}));
  scan.look(smaller_right, 30);
  EXPECT_FALSE(areOne(scan));
  EXPECT_EQ(scan.regionAt(kX, kY), whole) << "the larger side goes on";
}

TEST(GraphMerger, KeepsAWallTogether_WhenSegmentsSometimesCutIt) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.look(kLeak, 20);
  for (const int cut : {12, 20, 28, 36, 44, 52}) {
    const std::vector<Rectangle> in_two{{0, 0, cut, PaintedFrame::kHeight - 1},
                                        {cut + 1, 0, PaintedFrame::kWidth - 1, PaintedFrame::kHeight - 1}};
    // As many looks as cut a fragment, then a few that see the whole.
    for (int i = 0; i < 10; ++i) {
      const RegionEvents events = scan.look(i < FragmentSplitter::kObservations ? in_two : kLeak).events;
      EXPECT_THAT(events.parted, testing::IsEmpty()) << "cut at " << cut << ", look " << i;
      EXPECT_THAT(events.joined, testing::IsEmpty()) << "cut at " << cut << ", look " << i;
    }
  }
  EXPECT_TRUE(areOne(scan));
}

TEST(GraphMerger, MustLinkOverridesEvidence) {
  PaintedScan scan(fold());
  scan.look(kClear, 20);
  ASSERT_FALSE(areOne(scan));
  scan.merger.constrain(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY), Constraint::must_link);
  for (int i = 0; i < 40; ++i) {
    scan.look(kClear);
    EXPECT_TRUE(areOne(scan)) << "frame " << i;
  }
}

TEST(GraphMerger, CannotLinkOverridesEvidence) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.look(kClear, 2);
  scan.merger.constrain(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY), Constraint::cannot_link);
  for (int i = 0; i < 40; ++i) {
    scan.look(kLeak);
    EXPECT_FALSE(areOne(scan)) << "frame " << i;
  }
}

TEST(GraphMerger, NewerConstraintWins) {
  PaintedScan scan(PaintedFrame::corner(0));
  scan.look(kClear, 2);
  const FragmentId left = scan.fragmentAt(kX, kY), right = scan.fragmentAt(kOtherX, kY);
  for (const bool as_one : {true, false, true, false}) {
    scan.merger.constrain(left, right, as_one ? Constraint::must_link : Constraint::cannot_link);
    scan.look(kClear);
    EXPECT_EQ(areOne(scan), as_one);
  }
}

TEST(GraphMerger, JoiningOddsFollowTheEvidenceOfBorders) {
  PaintedScan scan(fold());
  scan.look(kClear, 20);
  const auto odds = [&] {
    return scan.merger.joiningOdds(scan.regionAt(kX, kY), scan.regionAt(kOtherX, kY), scan.table, {},
                                   scan.params);
  };
  ASSERT_TRUE(odds());
  EXPECT_LT(*odds(), 0) << "two faces that were always seen as two";
  const float before = *odds();
  scan.look(kLeak, 3);
  ASSERT_FALSE(areOne(scan));
  EXPECT_GT(*odds(), before) << "some frames saw one";
  EXPECT_FALSE(scan.merger.joiningOdds(scan.regionAt(kX, kY), RegionId{999}, scan.table, {}, scan.params));
  scan.merger.constrain(scan.fragmentAt(kX, kY), scan.fragmentAt(kOtherX, kY), Constraint::cannot_link);
  EXPECT_FALSE(odds());
}

TEST(GraphMerger, JoinsRegionsOfMustBeOne_WithTheNextFrame) {
  PaintedScan scan(fold());
  scan.look(kClear, 20);
  scan.merger.mustBeOne(scan.regionAt(kX, kY), scan.regionAt(kOtherX, kY), scan.table);
  EXPECT_FALSE(areOne(scan));
  for (int i = 0; i < 40; ++i) {
    scan.look(kClear);
    EXPECT_TRUE(areOne(scan)) << "frame " << i;
  }
}

TEST(GraphMerger, RepairsAnOutline_WhenClearFramesFollow) {
  // The right face's fragment reaches eight pixels on to the left face; clear looks take that back.
  PaintedScan scan(fold());
  scan.look({{0, 0, kMiddle - 9, PaintedFrame::kHeight - 1}, {kMiddle - 8, 0, 63, PaintedFrame::kHeight - 1}},
            3);
  ASSERT_EQ(scan.fragmentAt(kMiddle - 4, kY), scan.fragmentAt(kOtherX, kY));
  scan.look(kClear, 30);
  EXPECT_EQ(scan.regionAt(kMiddle - 4, kY), scan.regionAt(kX, kY));
  EXPECT_NE(scan.regionAt(kMiddle - 4, kY), scan.regionAt(kOtherX, kY));
}

TEST(GraphMerger, KeepsACoveredFragment) {
  // A segment over both covers the smaller fragment and so leaves its pixels alone.
  PaintedScan scan(fold());
  const Rectangle thing{kMiddle + 10, 10, kMiddle + 20, 30};
  scan.look({PaintedFrame::kLeft, PaintedFrame::kRight, thing}, 3);
  const FragmentId fragment = scan.fragmentAt(kMiddle + 15, 20);
  scan.look(kClear, 40);
  EXPECT_EQ(scan.fragmentAt(kMiddle + 15, 20), fragment);
}

TEST(GraphMerger, RemovesEvidence_WhenAFragmentIsForgotten) {
  PaintedScan scan(fold());
  scan.look(kClear, 5);
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
      const auto& outcome = scan.look(segments);
      seen.insert(seen.end(), outcome.regions.begin(), outcome.regions.end());
    }
    EXPECT_GT(scan.merger.graph().borderCount(), 10U);
    return seen;
  };
  EXPECT_EQ(scanOnce(), scanOnce());
}

}  // namespace
}  // namespace scantrove
