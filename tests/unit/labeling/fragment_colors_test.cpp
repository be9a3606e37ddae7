#include "core/labeling/fragment_colors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/labeling/painted_frame.h"

namespace scantrove {
namespace {

using test::PaintedFrame;
constexpr FragmentId kLeftFragment{3}, kRightFragment{8};

PaintedFrame twoFragments() {
  PaintedFrame frame = PaintedFrame::corner(0);
  PaintedFrame::fill(frame.view.fragments, PaintedFrame::kLeft, kLeftFragment);
  PaintedFrame::fill(frame.view.fragments, PaintedFrame::kRight, kRightFragment);
  return frame;
}

std::optional<ColorComparison> comparisonIn(const PaintedFrame& frame) {
  const FragmentColors colors(frame.input(), frame.view.fragments);
  const auto one = colors.between(kLeftFragment, kRightFragment),
             other = colors.between(kRightFragment, kLeftFragment);
  EXPECT_EQ(one.has_value(), other.has_value());
  if (one && other) {
    for (const auto value :
         {&ColorComparison::difference, &ColorComparison::chroma_difference, &ColorComparison::shared,
          &ColorComparison::shared_chroma, &ColorComparison::elsewhere, &ColorComparison::variety})
      EXPECT_FLOAT_EQ((*one).*value, (*other).*value);
  }
  return one;
}

TEST(FragmentColors, DifferenceComparesMeans_AndChromaIgnoresBrightness) {
  PaintedFrame frame = twoFragments();
  frame.color_lab.assign(PaintedFrame::kPixels, {40, 10, 0});
  PaintedFrame::fill(frame.color_lab, PaintedFrame::kRight, Eigen::Vector3f(52, 13, 4));
  // Light and dark stripes cancel out.
  for (int y = 0; y < PaintedFrame::kHeight; ++y) {
    const float stripe = y % 2 == 0 ? 20.0F : -20.0F;
    for (int x = 0; x < PaintedFrame::kWidth; ++x)
      frame.color_lab[static_cast<std::size_t>(y * PaintedFrame::kWidth + x)].x() += stripe;
  }
  const auto compared = comparisonIn(frame);
  ASSERT_TRUE(compared);
  EXPECT_NEAR(compared->difference, 13, 1e-3F);        // of (12, 3, 4)
  EXPECT_NEAR(compared->chroma_difference, 5, 1e-3F);  // of (3, 4)
}

TEST(FragmentColors, ComparisonIsNone_WithoutColorOrSurface) {
  PaintedFrame frame = twoFragments();
  EXPECT_FALSE(comparisonIn(frame));
  frame.color_lab.assign(PaintedFrame::kPixels, {40, 10, 0});
  EXPECT_TRUE(comparisonIn(frame));
  PaintedFrame::fill(frame.view.vertices_world, PaintedFrame::kRight, Eigen::Vector4f(0, 0, 0, 0));
  EXPECT_FALSE(comparisonIn(frame)) << "one fragment has no surface";
}

TEST(FragmentColors, IgnoresPixelsWithoutSurface) {
  PaintedFrame frame = twoFragments();
  frame.color_lab.assign(PaintedFrame::kPixels, {40, 10, 0});
  constexpr test::Rectangle kHole{40, 5, 60, 40};
  PaintedFrame::fill(frame.color_lab, kHole, Eigen::Vector3f(90, -50, 0));
  PaintedFrame::fill(frame.view.vertices_world, kHole, Eigen::Vector4f(0, 0, 0, 0));
  EXPECT_NEAR(comparisonIn(frame)->difference, 0, 1e-4F);
}

// Colours at bin centres of ChromaHistogram.
const Eigen::Vector3f kRed(50, 36, 4), kGreen(50, -36, 4), kGray(50, 4, 4);
constexpr test::Rectangle kUpperLeft{0, 0, PaintedFrame::kWidth / 2 - 1, PaintedFrame::kHeight / 2 - 1};
constexpr test::Rectangle kUpperRight{PaintedFrame::kWidth / 2, 0, PaintedFrame::kWidth - 1,
                                      PaintedFrame::kHeight / 2 - 1};

TEST(FragmentColors, SharedIsTheOverlapOfChromaHistograms) {
  PaintedFrame frame = twoFragments();
  frame.color_lab.assign(PaintedFrame::kPixels, kRed);
  PaintedFrame::fill(frame.color_lab, kUpperLeft, kGreen);
  const auto half = comparisonIn(frame);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->shared, 0.5F, 1e-4F) << "one is half green, the other all red";
  EXPECT_NEAR(half->shared_chroma, 0.5F * std::hypot(36.0F, 4.0F), 1e-2F);
  PaintedFrame::fill(frame.color_lab, kUpperRight, kGreen);
  EXPECT_NEAR(comparisonIn(frame)->shared, 1, 1e-4F) << "both have the same pattern";
  // Brightness does not affect chroma.
  PaintedFrame::fill(frame.color_lab, PaintedFrame::kLeft, kRed);
  PaintedFrame::fill(frame.color_lab, PaintedFrame::kRight, Eigen::Vector3f(20, kRed[1], kRed[2]));
  EXPECT_NEAR(comparisonIn(frame)->shared, 1, 1e-4F);
  PaintedFrame::fill(frame.color_lab, PaintedFrame::kRight, kGreen);
  EXPECT_NEAR(comparisonIn(frame)->shared, 0, 1e-4F);
  EXPECT_NEAR(comparisonIn(frame)->shared_chroma, 0, 1e-4F);
}

TEST(FragmentColors, ElsewhereIsTheShareOfCommonChromasInOtherFragments) {
  PaintedFrame frame = twoFragments();
  frame.color_lab.assign(PaintedFrame::kPixels, kRed);
  EXPECT_EQ(comparisonIn(frame)->elsewhere, 0) << "there are no other fragments";
  constexpr test::Rectangle kRest{0, 0, PaintedFrame::kWidth - 1, 9};
  PaintedFrame::fill(frame.view.fragments, kRest, FragmentId{5});
  EXPECT_NEAR(comparisonIn(frame)->elsewhere, 1, 1e-4F);
  PaintedFrame::fill(frame.color_lab, {0, 0, PaintedFrame::kWidth / 4 - 1, 9}, kGray);
  EXPECT_NEAR(comparisonIn(frame)->elsewhere, 0.75F, 1e-4F);
  PaintedFrame::fill(frame.color_lab, kRest, kGreen);
  EXPECT_NEAR(comparisonIn(frame)->elsewhere, 0, 1e-4F);
}

TEST(FragmentColors, VarietyIsThatOfThePlainerFragment) {
  PaintedFrame frame = twoFragments();
  frame.color_lab.assign(PaintedFrame::kPixels, kGray);
  PaintedFrame::fill(frame.color_lab, kUpperLeft, kRed);
  EXPECT_NEAR(comparisonIn(frame)->variety, 0, 0.05F) << "the right one is all grey";
  PaintedFrame::fill(frame.color_lab, kUpperRight, Eigen::Vector3f(60, 4, 4));
  EXPECT_NEAR(comparisonIn(frame)->variety, 5, 1e-2F) << "half 50, half 60; the left one varies by 16";
}

}  // namespace
}  // namespace scantrove
