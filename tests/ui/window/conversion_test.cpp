#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "core/exchange/region_palette.h"
#include "ui/panels/image_conversion.h"
#include "ui/panels/source_dialog.h"

namespace scantrove {
namespace {

TEST(ImageConversion, ColorKeepsChannelsAndSharesPixels) {
  QImage picture;
  {
    cv::Mat bgr(3, 5, CV_8UC3, cv::Scalar(10, 20, 30));
    picture = colorPicture(bgr);
  }  // the picture shares ownership of the pixels
  ASSERT_EQ(picture.size(), QSize(5, 3));
  EXPECT_EQ(picture.pixelColor(4, 2), QColor(30, 20, 10));
  EXPECT_TRUE(colorPicture({}).isNull());
  EXPECT_TRUE(colorPicture(cv::Mat(2, 2, CV_8UC1)).isNull());
}

TEST(ImageConversion, DepthIsRedWhenNear_BlueWhenFar_DarkWithoutReading) {
  cv::Mat depth(1, 5, CV_32FC1);
  depth.at<float>(0) = 0;
  depth.at<float>(1) = std::numeric_limits<float>::quiet_NaN();
  depth.at<float>(2) = 1.0F;
  depth.at<float>(3) = 3.0F;
  depth.at<float>(4) = 100;
  const QImage picture = depthPicture(depth, {1, 3});
  EXPECT_LT(picture.pixelColor(0, 0).lightness(), 40);
  EXPECT_EQ(picture.pixel(1, 0), picture.pixel(0, 0));
  EXPECT_GT(picture.pixelColor(2, 0).red(), picture.pixelColor(2, 0).blue());
  EXPECT_GT(picture.pixelColor(3, 0).blue(), picture.pixelColor(3, 0).red());
  EXPECT_EQ(picture.pixel(4, 0), picture.pixel(3, 0));
}

TEST(ImageConversion, RangeIgnoresMissingReadingsAndOutliers) {
  cv::Mat depth = cv::Mat::zeros(100, 100, CV_32FC1);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) depth.at<float>(y, x) = y < 50 ? 0.0F : 1.0F + static_cast<float>(x) / 100;
  }
  depth.at<float>(60, 60) = 50;
  const DepthRange range = usualRange(depth, {});
  EXPECT_NEAR(range.near_m, 1.0F, 0.06F);
  EXPECT_NEAR(range.far_m, 2.0F, 0.06F);
  const DepthRange unchanged = usualRange(cv::Mat(), {0.7F, 5});
  EXPECT_EQ(unchanged.near_m, 0.7F);
}

TEST(ImageConversion, RegionsHaveTheColorsOfThe3DView) {
  cv::Mat regions(4, 4, CV_32SC1, cv::Scalar(17));
  regions.at<int>(0, 0) = 0;
  const QImage picture = regionPicture(regions);
  const Rgb expected = regionColor(RegionId{17});
  EXPECT_EQ(picture.pixelColor(2, 2), QColor(expected[0], expected[1], expected[2]));
  EXPECT_LT(picture.pixelColor(0, 0).lightness(), 40);
}

TEST(ParseIntrinsics, AcceptsFourPositiveNumbersOnly) {
  const auto K = parseIntrinsics(QStringLiteral(" 585, 586,320 , 240.5"));
  ASSERT_TRUE(K);
  EXPECT_FLOAT_EQ(K->fx, 585);
  EXPECT_FLOAT_EQ(K->cy, 240.5F);
  EXPECT_FALSE(parseIntrinsics(QStringLiteral("585,585,320")));
  EXPECT_FALSE(parseIntrinsics(QStringLiteral("585,x,320,240")));
  EXPECT_FALSE(parseIntrinsics(QStringLiteral("-1,585,320,240")));
}

}  // namespace
}  // namespace scantrove
