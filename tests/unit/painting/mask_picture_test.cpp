#include "ui/painting/mask_picture.h"

#include <gtest/gtest.h>

#include <QColor>
#include <opencv2/core.hpp>

#include "core/exchange/region_palette.h"

namespace scantrove::test {
namespace {

cv::Mat twoMasks() {
  cv::Mat regions = cv::Mat::zeros(20, 30, CV_32SC1);
  regions(cv::Rect(5, 5, 10, 10)).setTo(5);
  regions(cv::Rect(15, 5, 10, 10)).setTo(7);
  return regions;
}

TEST(MaskPicture, FillsEachRegionInItsColor) {
  const QImage picture = maskPicture(twoMasks(), MaskStyle::fill);
  const Rgb color = regionColor(RegionId{5});
  EXPECT_EQ(picture.pixelColor(10, 10), QColor(color[0], color[1], color[2]));
  EXPECT_EQ(picture.pixelColor(2, 2).alpha(), 0);
  EXPECT_NE(picture.pixelColor(10, 10), picture.pixelColor(20, 10));
}

TEST(MaskPicture, OutlinesLeaveTheInsideFree) {
  const QImage picture = maskPicture(twoMasks(), MaskStyle::outline);
  EXPECT_EQ(picture.pixelColor(10, 10).alpha(), 0);
  EXPECT_EQ(picture.pixelColor(5, 10).alpha(), 255);
  EXPECT_EQ(picture.pixelColor(14, 10).alpha(), 255);
  EXPECT_TRUE(maskPicture(twoMasks(), MaskStyle::none).isNull());
  EXPECT_TRUE(maskPicture({}, MaskStyle::fill).isNull());
}

TEST(MaskPicture, DraftChangesOnlyThePart) {
  QImage picture = emptyDraft({30, 20});
  cv::Mat draft(20, 30, CV_8UC1, cv::Scalar(255));
  paintDraft(picture, draft, QRect(4, 4, 3, 2), QColor(255, 0, 0));
  EXPECT_EQ(picture.pixelColor(4, 4), QColor(255, 0, 0));
  EXPECT_EQ(picture.pixelColor(6, 5), QColor(255, 0, 0));
  EXPECT_EQ(picture.pixelColor(7, 5).alpha(), 0);
  paintDraft(picture, cv::Mat::zeros(20, 30, CV_8UC1), QRect(4, 4, 1, 1), QColor(255, 0, 0));
  EXPECT_EQ(picture.pixelColor(4, 4).alpha(), 0);
  paintDraft(picture, draft, QRect(-5, -5, 100, 100), QColor(255, 0, 0));
  EXPECT_EQ(picture.pixelColor(29, 19), QColor(255, 0, 0));
}

TEST(MaskPicture, NamesStandOnTheirRegions) {
  cv::Mat ring(40, 40, CV_32SC1, cv::Scalar(5));
  ring(cv::Rect(5, 5, 30, 30)).setTo(7);
  const auto names = maskNames(
      ring, [](RegionId region) { return region == RegionId{5} ? QStringLiteral("frame") : QString(); });
  ASSERT_EQ(names.size(), 1U);
  EXPECT_EQ(names[0].text, QStringLiteral("frame"));
  EXPECT_EQ(ring.at<int>(static_cast<int>(names[0].at.y()), static_cast<int>(names[0].at.x())), 5)
      << "its middle is another region";
}

}  // namespace
}  // namespace scantrove::test
