#include "core/discovery/small_components.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// A mask of 40 x 30 pixels whose middle 20 x 20 are set.
struct SmallComponentsTest : testing::Test {
  void fill(const cv::Rect& area, int value) { mask(area).setTo(value); }
  [[nodiscard]] int inside() const { return cv::countNonZero(mask); }

  cv::Mat mask = cv::Mat::zeros(30, 40, CV_8UC1);
  cv::Rect box{100, 50, 40, 30};
  SmallComponentsTest() { fill({10, 5, 20, 20}, 255); }
};

TEST_F(SmallComponentsTest, RemovesSmallComponentsAndCropsTheBox) {
  fill({0, 0, 3, 3}, 255);
  fill({38, 29, 2, 1}, 255);
  dropSmallComponents(mask, box);
  EXPECT_EQ(box, cv::Rect(110, 55, 20, 20));
  EXPECT_EQ(mask.size(), box.size());
  EXPECT_EQ(inside(), 400);
}

TEST_F(SmallComponentsTest, KeepsAPart_WhenAnOccluderSeparatesIt) {
  fill({36, 5, 4, 20}, 255);  // 80 of 480 pixels
  dropSmallComponents(mask, box);
  EXPECT_EQ(box, cv::Rect(110, 55, 30, 20));
  EXPECT_EQ(inside(), 480);
}

TEST_F(SmallComponentsTest, ClosesSmallHolesOnly) {
  fill({12, 8, 2, 2}, 0);
  fill({15, 10, 1, 1}, 0);
  fill({20, 10, 6, 6}, 0);  // like the hole of a handle
  dropSmallComponents(mask, box);
  EXPECT_EQ(inside(), 400 - 36);
  EXPECT_EQ(mask.at<unsigned char>(3, 2), 255);
}

TEST_F(SmallComponentsTest, KeepsANotchInTheOutline) {
  mask = mask(cv::Rect(10, 5, 20, 20)).clone();
  box = {110, 55, 20, 20};
  fill({0, 4, 2, 2}, 0);
  fill({9, 18, 2, 2}, 0);
  dropSmallComponents(mask, box);
  EXPECT_EQ(inside(), 400 - 8);
}

TEST_F(SmallComponentsTest, ClosesBothHoles_WhenTheyTouchAtACorner) {
  fill({14, 8, 1, 1}, 0);
  fill({15, 9, 1, 1}, 0);  // touches the other at a corner only
  dropSmallComponents(mask, box);
  EXPECT_EQ(inside(), 400);
}

TEST_F(SmallComponentsTest, KeepsTheLargestComponent_WhenAllAreSmall) {
  mask.setTo(0);
  for (int i = 0; i < 30; ++i) fill({i % 10 * 4, i / 10 * 4, 2, 2}, 255);  // each a thirtieth
  fill({20, 20, 3, 2}, 255);
  dropSmallComponents(mask, box);
  EXPECT_EQ(box, cv::Rect(120, 70, 3, 2));
  EXPECT_EQ(inside(), 6);
}

TEST_F(SmallComponentsTest, KeepsAnEmptyMask) {
  mask.setTo(0);
  dropSmallComponents(mask, box);
  EXPECT_EQ(box, cv::Rect(100, 50, 40, 30));
  EXPECT_EQ(inside(), 0);
}

}  // namespace
}  // namespace scantrove
