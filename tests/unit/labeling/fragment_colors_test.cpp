#include "core/labeling/fragment_colors.h"

#include <gtest/gtest.h>

#include "tests/unit/labeling/painted_frame.h"

namespace scantrove {
namespace {

using test::PaintedFrame;
constexpr FragmentId kLeftThing{3}, kRightThing{8};

PaintedFrame twoThings() {
  PaintedFrame frame = PaintedFrame::corner(0);
  PaintedFrame::fill(frame.projected, PaintedFrame::kLeft, kLeftThing);
  PaintedFrame::fill(frame.projected, PaintedFrame::kRight, kRightThing);
  return frame;
}

std::optional<ColorDifference> differenceIn(const PaintedFrame& frame) {
  const FragmentColors colors(frame.input(), frame.projected);
  const auto one = colors.between(kLeftThing, kRightThing), other = colors.between(kRightThing, kLeftThing);
  EXPECT_EQ(one.has_value(), other.has_value());
  if (one && other) {
    EXPECT_FLOAT_EQ(one->all, other->all);
    EXPECT_FLOAT_EQ(one->chroma, other->chroma);
  }
  return one;
}

TEST(FragmentColors, DifferByTheirMeansAndChromaLeavesBrightnessOut) {
  PaintedFrame frame = twoThings();
  frame.color_lab.assign(PaintedFrame::kPixels, {40, 10, 0});
  PaintedFrame::fill(frame.color_lab, PaintedFrame::kRight, Eigen::Vector3f(52, 13, 4));
  // Stripes do not count: as many of them are lighter as are darker.
  for (int y = 0; y < PaintedFrame::kHeight; ++y) {
    const float stripe = y % 2 == 0 ? 20.0F : -20.0F;
    for (int x = 0; x < PaintedFrame::kWidth; ++x)
      frame.color_lab[static_cast<std::size_t>(y * PaintedFrame::kWidth + x)].x() += stripe;
  }
  const auto difference = differenceIn(frame);
  ASSERT_TRUE(difference);
  EXPECT_NEAR(difference->all, 13, 1e-3F);    // of (12, 3, 4)
  EXPECT_NEAR(difference->chroma, 5, 1e-3F);  // of (3, 4)
}

TEST(FragmentColors, AreNotKnownWithoutColorNorOfWhatIsNotSeen) {
  PaintedFrame frame = twoThings();
  EXPECT_FALSE(differenceIn(frame));
  frame.color_lab.assign(PaintedFrame::kPixels, {40, 10, 0});
  EXPECT_TRUE(differenceIn(frame));
  PaintedFrame::fill(frame.vertices, PaintedFrame::kRight, Eigen::Vector4f(0, 0, 0, 0));
  EXPECT_FALSE(differenceIn(frame)) << "there is no surface of it";
}

TEST(FragmentColors, PixelsWithoutSurfaceDoNotCount) {
  PaintedFrame frame = twoThings();
  frame.color_lab.assign(PaintedFrame::kPixels, {40, 10, 0});
  constexpr test::Rectangle kHole{40, 5, 60, 40};
  PaintedFrame::fill(frame.color_lab, kHole, Eigen::Vector3f(90, -50, 0));
  PaintedFrame::fill(frame.vertices, kHole, Eigen::Vector4f(0, 0, 0, 0));
  EXPECT_NEAR(differenceIn(frame)->all, 0, 1e-4F);
}

}  // namespace
}  // namespace scantrove
