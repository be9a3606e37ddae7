// Image files before and while they are decoded: size, damage, and what the decoders make of them.
#include "core/image/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/image/image_header.h"
#include "core/image/image_integrity.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ImageHeader, TellsTheSizeOfEveryFormat) {
  for (const char* extension : {".png", ".jpg", ".bmp", ".ppm", ".pgm", ".tif"}) {
    std::vector<uchar> bytes;
    const cv::Mat image(24, 37, std::string(extension) == ".pgm" ? CV_8UC1 : CV_8UC3, cv::Scalar::all(90));
    ASSERT_TRUE(cv::imencode(extension, image, bytes)) << extension;
    const auto size = imageSize(bytes);
    ASSERT_TRUE(size) << extension;
    EXPECT_EQ(*size, (ImageSize{37, 24})) << extension;
    EXPECT_FALSE(imageSize({bytes.data(), 2})) << extension;
  }
  const std::string commented = "P5 # made\n# by hand\n 640 # wide\n480\n255\n";
  EXPECT_EQ(imageSize({reinterpret_cast<const uchar*>(commented.data()), commented.size()}),
            (ImageSize{640, 480}));
}

/// What our decoders give is what OpenCV gives.
TEST(ImageDecoders, GiveWhatOpenCvGives) {
  cv::Mat color(45, 61, CV_8UC3), alpha(45, 61, CV_8UC4), deep(45, 61, CV_16UC3), grey(45, 61, CV_8UC1),
      depth(45, 61, CV_16UC1);
  for (cv::Mat* image : {&color, &alpha, &deep, &grey, &depth})
    cv::randu(*image, 0, image->depth() == CV_8U ? 255 : 65000);
  cv::GaussianBlur(color, color, {9, 9}, 3);
  for (const char* extension : {".png", ".jpg"}) {
    for (const cv::Mat& image : {color, alpha, deep, grey, depth}) {
      if (std::string(extension) == ".jpg" && (image.depth() != CV_8U || image.channels() == 4)) continue;
      std::vector<uchar> bytes;
      ASSERT_TRUE(cv::imencode(extension, image, bytes));
      const auto ours = decodeColorImage(bytes, "x");
      ASSERT_TRUE(ours) << ours.error().message();
      EXPECT_EQ(cv::norm(*ours, cv::imdecode(bytes, cv::IMREAD_COLOR), cv::NORM_INF), 0)
          << extension << image.type();
    }
  }
}

TEST(ImageDecoders, SayWhatIsDamagedAndPrintNothing) {
  cv::Mat noise(48, 64, CV_8UC3);
  cv::randu(noise, 0, 255);
  std::vector<uchar> png, jpeg;
  cv::imencode(".png", noise, png);
  cv::imencode(".jpg", noise, jpeg);
  png[png.size() / 2] ^= 0x55;
  jpeg[jpeg.size() / 2] = 0xFF;  // an end marker in the middle: libjpeg would paint the rest grey
  jpeg[jpeg.size() / 2 + 1] = 0xD9;
  testing::internal::CaptureStderr();
  for (const std::vector<uchar>& bytes : {png, jpeg}) {
    const auto image = decodeColorImage(bytes, "picture");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().what, testing::StartsWith("picture cannot be decoded: it is damaged ("));
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
}

TEST(ImageDamage, IsFoundAtEveryLength) {
  std::vector<uchar> png, jpeg;
  cv::Mat noise(24, 32, CV_8UC3);
  cv::randu(noise, 0, 255);
  cv::imencode(".png", noise, png);
  cv::imencode(".jpg", noise, jpeg);
  for (const std::vector<uchar>& image : {png, jpeg}) {
    EXPECT_THAT(findImageDamage(image), IsEmpty());
    for (std::size_t length = 0; length < image.size(); ++length) {
      EXPECT_FALSE(findImageDamage({image.data(), length}).empty()) << length << " of " << image.size();
    }
  }
}

TEST(ImageDamage, OfPixelsThatAreMissingIsFound) {
  cv::Mat noise(24, 32, CV_16UC1);
  cv::randu(noise, 0, 60000);
  for (const char* extension : {".pgm", ".bmp"}) {
    std::vector<uchar> image;
    cv::imencode(extension, std::string(extension) == ".pgm" ? noise : cv::Mat(24, 32, CV_8UC3), image);
    EXPECT_THAT(findImageDamage(image), IsEmpty()) << extension;
    for (std::size_t length = 6; length < image.size(); ++length) {
      EXPECT_FALSE(findImageDamage({image.data(), length}).empty()) << extension << length;
    }
  }
}

TEST(ImageDamage, TrailingBytesAreNoDamage) {
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", cv::Mat(24, 32, CV_8UC3, cv::Scalar(20, 90, 160)), jpeg);
  jpeg.insert(jpeg.end(), 100, 0);
  EXPECT_THAT(findImageDamage(jpeg), IsEmpty());
}

TEST(ImageDamage, FlippedBitsAreAnErrorNotAPicture) {
  const TemporaryFolder folder;
  std::vector<uchar> png;
  cv::Mat noise(24, 32, CV_16UC1);
  cv::randu(noise, 0, 60000);
  cv::imencode(".png", noise, png);
  png[png.size() / 2] ^= 0x40;
  const auto file = folder.write("depth.png", std::string(png.begin(), png.end()));
  const auto image = readDepthImage(file);
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().what, HasSubstr("depth.png"));
}

}  // namespace
}  // namespace scantrove
