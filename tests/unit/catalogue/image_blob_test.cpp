#include "core/catalogue/image_blob.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <stdexcept>

namespace scantrove {
namespace {

cv::Mat noise(int type) {
  cv::Mat image(31, 17, type);
  cv::randu(image, 0, image.depth() == CV_8U ? 256 : 65536);
  return image;
}

TEST(ImageBlob, ReadsBackPngExactlyAndJpegClosely) {
  for (const int type : {CV_8UC3, CV_8UC1, CV_16UC1}) {
    const cv::Mat image = noise(type), read = decodedImage(toPng(image));
    ASSERT_EQ(read.type(), type);
    EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0);
  }
  const cv::Mat picture = decodedImage(toJpeg(cv::Mat(31, 17, CV_8UC3, cv::Scalar(40, 80, 120))));
  ASSERT_EQ(picture.size(), cv::Size(17, 31));
  EXPECT_LE(cv::norm(picture, cv::Mat(31, 17, CV_8UC3, cv::Scalar(40, 80, 120)), cv::NORM_INF), 3);
}

TEST(ImageBlob, IsEmptyAndNotNull_WhenTheImageIsEmpty) {
  EXPECT_FALSE(toPng({}).isNull());
  EXPECT_TRUE(toPng({}).isEmpty());
  EXPECT_TRUE(toJpeg({}).isEmpty());
  EXPECT_TRUE(decodedImage({}).empty());
  EXPECT_TRUE(decodedImage("no image").empty());
}

// A damaged database must not make the program allocate the claimed size.
TEST(ImageBlob, DecodesToNothing_WhenTheHeaderClaimsTooManyPixels) {
  QByteArray png = toPng(noise(CV_8UC3));
  png.replace(16, 8, QByteArray::fromHex("7fffffff7fffffff"));
  EXPECT_TRUE(decodedImage(png).empty());
  QByteArray jpeg = toJpeg(noise(CV_8UC3));
  const qsizetype frame = jpeg.indexOf(QByteArray::fromHex("ffc0"));
  ASSERT_GT(frame, 0);
  jpeg.replace(frame + 5, 4, QByteArray::fromHex("ffdcffdc"));  // 65,500 x 65,500: 13 GB
  EXPECT_TRUE(decodedImage(jpeg).empty());
  EXPECT_TRUE(decodedImage(toJpeg(noise(CV_8UC3)).first(60)).empty()) << "truncated within its tables";
}

TEST(ImageBlob, Throws_WhenTheImageIsTooLargeToReadBack) {
  EXPECT_THROW(static_cast<void>(toPng(cv::Mat(1, 8193, CV_8UC1, cv::Scalar(1)))), std::runtime_error);
}

}  // namespace
}  // namespace scantrove
