#include "core/labeling/fragment_splitter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/labeling/painted_frame.h"

namespace scantrove {
namespace {

using test::PaintedFrame;
using test::Rectangle;
constexpr FragmentId kComplete{3};
constexpr Rectangle kSmall{PaintedFrame::kWidth / 2, 10, PaintedFrame::kWidth / 2 + 9, 37};

/// Observations of one fragment that covers a complete surface.
class FragmentSplitterTest : public testing::Test {
 protected:
  explicit FragmentSplitterTest(const PaintedFrame& frame = PaintedFrame::corner(1)) : frame_(frame) {
    PaintedFrame::fill(frame_.view.fragments, PaintedFrame::kAll, kComplete);
  }

  std::vector<FragmentSplitter::Split> observe(const std::vector<Rectangle>& segments) {
    frame_.segments = frame_.segmentsOf(segments);
    std::vector<FragmentId> owner(segments.size() + 1, kComplete);
    owner[0] = {};
    return splitter_.find(frame_.input(),
                          buildOverlapGraph<FragmentId>(frame_.segments, frame_.view.fragments), owner);
  }
  /// The number of the first of `count` observations that splits the fragment; 0 if none does.
  int firstSplit(const std::vector<Rectangle>& segments, int count) {
    for (int i = 1; i <= count; ++i) {
      if (!observe(segments).empty()) return i;
    }
    return 0;
  }

  PaintedFrame frame_;
  FragmentSplitter splitter_;
};

TEST_F(FragmentSplitterTest, Splits_WhenEnoughObservationsAgree) {
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, FragmentSplitter::kObservations - 1), 0);
  const auto splits = observe({PaintedFrame::kLeft, kSmall});
  ASSERT_EQ(splits.size(), 1U);
  EXPECT_EQ(splits.front().fragment, kComplete);
  EXPECT_EQ(splits.front().segment, 2U) << "the smaller side becomes a fragment";
  EXPECT_EQ(splits.front().contact.length_px, kSmall.bottom - kSmall.top + 1);
  EXPECT_NEAR(splits.front().contact.concavity_rad, 1, 1e-3F);
}

TEST_F(FragmentSplitterTest, IgnoresTheNumbersOfSegments) {
  ASSERT_TRUE(observe({PaintedFrame::kLeft, kSmall}).empty());
  ASSERT_TRUE(observe({kSmall, PaintedFrame::kLeft}).empty());
  const auto splits = observe({kSmall, PaintedFrame::kLeft});
  ASSERT_EQ(splits.size(), 1U);
  EXPECT_EQ(splits.front().segment, 1U);
}

TEST_F(FragmentSplitterTest, SplitsNothing_WhenObservationsDisagree) {
  // The segments differ in position or size each time.
  const int middle = PaintedFrame::kWidth / 2;
  for (int round = 0; round < FragmentSplitter::kObservations - 1; ++round) {
    EXPECT_TRUE(observe({PaintedFrame::kLeft, {middle, 0, middle + 9, 9}}).empty());
    EXPECT_TRUE(observe({PaintedFrame::kLeft, {middle, 15, middle + 9, 24}}).empty());
    EXPECT_TRUE(observe({PaintedFrame::kLeft, {middle, 30, middle + 9, 47}}).empty());
    EXPECT_TRUE(observe({PaintedFrame::kLeft, PaintedFrame::kRight}).empty());
  }
}

TEST_F(FragmentSplitterTest, CountsOneObservationPerFrame) {
  // Two other segments border on the small one in a fold.
  const Rectangle upper{0, 0, PaintedFrame::kWidth / 2 - 1, 23},
      lower{0, 24, PaintedFrame::kWidth / 2 - 1, 47};
  EXPECT_EQ(firstSplit({upper, lower, kSmall}, FragmentSplitter::kObservations),
            FragmentSplitter::kObservations);
}

TEST_F(FragmentSplitterTest, ForgetsObservationsFarApartInTime) {
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, FragmentSplitter::kObservations - 1), 0);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(observe({PaintedFrame::kAll}).empty());
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, 10), FragmentSplitter::kObservations);
}

TEST_F(FragmentSplitterTest, RemembersObservationsLonger_WhenTheyRepeat) {
  for (int i = 1; i < FragmentSplitter::kObservations; ++i) {
    EXPECT_TRUE(observe({PaintedFrame::kLeft, kSmall}).empty());
    for (int frame = 0; frame < 25; ++frame) EXPECT_TRUE(observe({PaintedFrame::kAll}).empty());
  }
  EXPECT_EQ(observe({PaintedFrame::kLeft, kSmall}).size(), 1U);
}

TEST_F(FragmentSplitterTest, NeedsMoreObservations_WhenSeenOften) {
  constexpr int kOften = 500;
  const int needed = FragmentSplitter::observationsNeeded(kOften + FragmentSplitter::kObservations);
  ASSERT_GT(needed, 2 * FragmentSplitter::kObservations);
  ASSERT_EQ(FragmentSplitter::observationsNeeded(100), FragmentSplitter::kObservations)
      << "too few frames to raise the number";
  for (int i = 0; i < kOften; ++i) ASSERT_TRUE(observe({PaintedFrame::kAll}).empty());
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, 2 * needed), needed);
  // A later fragment may reuse the number.
  for (int i = 0; i < kOften; ++i) ASSERT_TRUE(observe({PaintedFrame::kAll}).empty());
  splitter_.forget(kComplete);
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, needed), FragmentSplitter::kObservations);
}

TEST_F(FragmentSplitterTest, NeedsAtMostTwoSecondsOfObservations) {
  EXPECT_EQ(FragmentSplitter::observationsNeeded(1'000'000), FragmentSplitter::observationsNeeded(2'000));
  EXPECT_LT(FragmentSplitter::observationsNeeded(1'000'000), 60) << "two seconds";
}

TEST_F(FragmentSplitterTest, ForgetsAFragment_WhenItIsRemoved) {
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, FragmentSplitter::kObservations - 1), 0);
  splitter_.forget(kComplete);
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, kSmall}, 10), FragmentSplitter::kObservations);
}

TEST_F(FragmentSplitterTest, SplitsAFragmentOnceAFrame) {
  const Rectangle middle{24, 0, 39, 47}, upper{40, 0, 63, 23}, lower{40, 24, 63, 47};
  for (int i = 0; i < 20; ++i) {
    EXPECT_LE(observe({PaintedFrame::kLeft, middle, upper, lower}).size(), 1U);
  }
}

TEST_F(FragmentSplitterTest, IgnoresSegmentsOfOtherFragments) {
  for (int i = 0; i < 10; ++i) {
    frame_.segments = frame_.segmentsOf({PaintedFrame::kLeft, kSmall});
    const std::vector<FragmentId> owner{{}, kComplete, FragmentId{8}};
    EXPECT_TRUE(splitter_
                    .find(frame_.input(),
                          buildOverlapGraph<FragmentId>(frame_.segments, frame_.view.fragments), owner)
                    .empty());
  }
}

struct FragmentSplitterOnWallTest : FragmentSplitterTest {
  FragmentSplitterOnWallTest() : FragmentSplitterTest(PaintedFrame::corner(0)) {}
};
/// Books side by side are as smooth as a wall. Border evidence decides whether the parts are one region.
TEST_F(FragmentSplitterOnWallTest, SplitsASmoothSurface_WhenSegmentsAgree) {
  EXPECT_EQ(firstSplit({PaintedFrame::kLeft, PaintedFrame::kRight}, 10), FragmentSplitter::kObservations);
}

}  // namespace
}  // namespace scantrove
