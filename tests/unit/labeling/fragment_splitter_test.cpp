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

/// One fragment over all of a surface, and looks at it.
class FragmentCutterTest : public testing::Test {
 protected:
  explicit FragmentCutterTest(const PaintedFrame& frame = PaintedFrame::corner(1)) : frame_(frame) {
    PaintedFrame::fill(frame_.view.fragments, PaintedFrame::kAll, kComplete);
  }

  std::vector<FragmentSplitter::Cut> look(const std::vector<Rectangle>& segments) {
    frame_.segments = frame_.segmentsOf(segments);
    std::vector<FragmentId> owner(segments.size() + 1, kComplete);
    owner[0] = {};
    return cutter_.find(frame_.input(), buildOverlapGraph<FragmentId>(frame_.segments, frame_.view.fragments),
                        owner);
  }
  /// The look of `count` that first cut; 0: none did.
  int firstCut(const std::vector<Rectangle>& segments, int count) {
    for (int i = 1; i <= count; ++i) {
      if (!look(segments).empty()) return i;
    }
    return 0;
  }

  PaintedFrame frame_;
  FragmentSplitter cutter_;
};

TEST_F(FragmentCutterTest, CutsAfterSoManyLooksThatAgree) {
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, FragmentSplitter::kObservations - 1), 0);
  const auto cuts = look({PaintedFrame::kLeft, kSmall});
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_EQ(cuts.front().fragment, kComplete);
  EXPECT_EQ(cuts.front().segment, 2U) << "the smaller side is cut off";
  EXPECT_EQ(cuts.front().contact.length_px, kSmall.bottom - kSmall.top + 1);
  EXPECT_NEAR(cuts.front().contact.concavity_rad, 1, 1e-3F);
}

TEST_F(FragmentCutterTest, TheNumberOfASegmentDoesNotMatter) {
  ASSERT_TRUE(look({PaintedFrame::kLeft, kSmall}).empty());
  ASSERT_TRUE(look({kSmall, PaintedFrame::kLeft}).empty());
  const auto cuts = look({kSmall, PaintedFrame::kLeft});
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_EQ(cuts.front().segment, 1U);
}

TEST_F(FragmentCutterTest, LooksThatDisagreeCutNothing) {
  // Another place each time, or another size.
  const int middle = PaintedFrame::kWidth / 2;
  for (int round = 0; round < FragmentSplitter::kObservations - 1; ++round) {
    EXPECT_TRUE(look({PaintedFrame::kLeft, {middle, 0, middle + 9, 9}}).empty());
    EXPECT_TRUE(look({PaintedFrame::kLeft, {middle, 15, middle + 9, 24}}).empty());
    EXPECT_TRUE(look({PaintedFrame::kLeft, {middle, 30, middle + 9, 47}}).empty());
    EXPECT_TRUE(look({PaintedFrame::kLeft, PaintedFrame::kRight}).empty());
  }
}

TEST_F(FragmentCutterTest, OneFrameIsOneLookAtASide) {
  // The side meets two others in a fold.
  const Rectangle upper{0, 0, PaintedFrame::kWidth / 2 - 1, 23},
      lower{0, 24, PaintedFrame::kWidth / 2 - 1, 47};
  EXPECT_EQ(firstCut({upper, lower, kSmall}, FragmentSplitter::kObservations),
            FragmentSplitter::kObservations);
}

TEST_F(FragmentCutterTest, LooksFarApartInTimeAreForgotten) {
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, FragmentSplitter::kObservations - 1), 0);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(look({PaintedFrame::kAll}).empty());
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, 10), FragmentSplitter::kObservations);
}

TEST_F(FragmentCutterTest, EachLookMakesTheOnesBeforeLastLonger) {
  for (int i = 1; i < FragmentSplitter::kObservations; ++i) {
    EXPECT_TRUE(look({PaintedFrame::kLeft, kSmall}).empty());
    for (int frame = 0; frame < 25; ++frame) EXPECT_TRUE(look({PaintedFrame::kAll}).empty());
  }
  EXPECT_EQ(look({PaintedFrame::kLeft, kSmall}).size(), 1U);
}

TEST_F(FragmentCutterTest, WhatWasSeenOftenTakesMoreLooks) {
  constexpr int kOften = 500;
  const int needed = FragmentSplitter::observationsNeeded(kOften + FragmentSplitter::kObservations);
  ASSERT_GT(needed, 2 * FragmentSplitter::kObservations);
  ASSERT_EQ(FragmentSplitter::observationsNeeded(100), FragmentSplitter::kObservations) << "not yet often";
  for (int i = 0; i < kOften; ++i) ASSERT_TRUE(look({PaintedFrame::kAll}).empty());
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, 2 * needed), needed);
  // Its number may be another fragment's later.
  for (int i = 0; i < kOften; ++i) ASSERT_TRUE(look({PaintedFrame::kAll}).empty());
  cutter_.forget(kComplete);
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, needed), FragmentSplitter::kObservations);
}

TEST_F(FragmentCutterTest, NeverTakesMoreLooksThanAThingThatComesIsSeenIn) {
  EXPECT_EQ(FragmentSplitter::observationsNeeded(1'000'000), FragmentSplitter::observationsNeeded(2'000));
  EXPECT_LT(FragmentSplitter::observationsNeeded(1'000'000), 60) << "two seconds";
}

TEST_F(FragmentCutterTest, ForgetsAFragmentThatIsNoMore) {
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, FragmentSplitter::kObservations - 1), 0);
  cutter_.forget(kComplete);
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, kSmall}, 10), FragmentSplitter::kObservations);
}

TEST_F(FragmentCutterTest, OneFragmentIsCutOnceAFrame) {
  const Rectangle middle{24, 0, 39, 47}, upper{40, 0, 63, 23}, lower{40, 24, 63, 47};
  for (int i = 0; i < 20; ++i) {
    EXPECT_LE(look({PaintedFrame::kLeft, middle, upper, lower}).size(), 1U);
  }
}

TEST_F(FragmentCutterTest, ASegmentOfAnotherFragmentIsNoSide) {
  for (int i = 0; i < 10; ++i) {
    frame_.segments = frame_.segmentsOf({PaintedFrame::kLeft, kSmall});
    const std::vector<FragmentId> owner{{}, kComplete, FragmentId{8}};
    EXPECT_TRUE(cutter_
                    .find(frame_.input(),
                          buildOverlapGraph<FragmentId>(frame_.segments, frame_.view.fragments), owner)
                    .empty());
  }
}

struct FragmentCutterOnAWall : FragmentCutterTest {
  FragmentCutterOnAWall() : FragmentCutterTest(PaintedFrame::corner(0)) {}
};
/// Books side by side are as smooth as a wall; whether the parts are one is for the evidence of their border
/// to say.
TEST_F(FragmentCutterOnAWall, CutsWhatIsSmoothTooWhereSegmentsAgree) {
  EXPECT_EQ(firstCut({PaintedFrame::kLeft, PaintedFrame::kRight}, 10), FragmentSplitter::kObservations);
}

}  // namespace
}  // namespace scantrove
