// Sizes, damage and decoding of image files.
#include "core/image/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spng.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/image/image_header.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ImageHeader, GivesTheSize_OfEveryFormat) {
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

/// A PNG of 13 x 11 pixels of noise, made by libspng.
std::vector<uchar> makePng(int color_type, int bits, bool is_interlaced) {
  constexpr int kWidth = 13, kHeight = 11;
  spng_ctx* const encoder = spng_ctx_new(SPNG_CTX_ENCODER);
  spng_set_option(encoder, SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{kWidth,
                   kHeight,
                   static_cast<std::uint8_t>(bits),
                   static_cast<std::uint8_t>(color_type),
                   0,
                   0,
                   static_cast<std::uint8_t>(is_interlaced ? 1 : 0)};
  EXPECT_EQ(spng_set_ihdr(encoder, &header), 0);
  if (color_type == SPNG_COLOR_TYPE_INDEXED) {
    spng_plte palette{};
    palette.n_entries = 1U << static_cast<unsigned>(bits);
    for (std::uint32_t i = 0; i < palette.n_entries; ++i)
      palette.entries[i] = {static_cast<std::uint8_t>(3 * i), static_cast<std::uint8_t>(255 - i),
                            static_cast<std::uint8_t>(7 * i), 255};
    EXPECT_EQ(spng_set_plte(encoder, &palette), 0);
  }
  const int channels = color_type == 2 ? 3 : color_type == 4 ? 2 : color_type == 6 ? 4 : 1;
  cv::Mat rows(kHeight, (kWidth * channels * bits + 7) / 8, CV_8UC1);
  cv::randu(rows, 0, 256);
  EXPECT_EQ(spng_encode_image(encoder, rows.data, rows.total(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  std::size_t size = 0;
  int error = 0;
  auto* const png = static_cast<uchar*>(spng_get_png_buffer(encoder, &size, &error));
  std::vector<uchar> bytes(png, png + size);
  std::free(png);
  spng_ctx_free(encoder);
  return bytes;
}

TEST(ImageDecoders, EqualOpenCv_ForEveryChannelCountAndDepth) {
  cv::Mat color(45, 61, CV_8UC3), alpha(45, 61, CV_8UC4), deep(45, 61, CV_16UC3), gray(45, 61, CV_8UC1),
      depth(45, 61, CV_16UC1);
  for (cv::Mat* image : {&color, &alpha, &deep, &gray, &depth})
    cv::randu(*image, 0, image->depth() == CV_8U ? 255 : 65000);
  cv::GaussianBlur(color, color, {9, 9}, 3);
  for (const char* extension : {".png", ".jpg"}) {
    for (const cv::Mat& image : {color, alpha, deep, gray, depth}) {
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

TEST(ImageDecoders, EqualOpenCv_ForEveryKindOfPng) {
  for (const int bits : {1, 2, 4, 8, 16}) {
    for (const int color_type : {0, 2, 3, 4, 6}) {
      const bool is_kind = color_type == 0 || (color_type == 3 ? bits <= 8 : bits >= 8);
      if (!is_kind) continue;
      for (const bool is_interlaced : {false, true}) {
        SCOPED_TRACE(testing::Message()
                     << bits << " bits, color type " << color_type << (is_interlaced ? ", interlaced" : ""));
        const std::vector<uchar> png = makePng(color_type, bits, is_interlaced);
        const auto color = decodeColorImage(png, "x");
        ASSERT_TRUE(color) << color.error().message();
        EXPECT_EQ(cv::norm(*color, cv::imdecode(png, cv::IMREAD_COLOR), cv::NORM_INF), 0);
        const auto gray = decodeGrayImage(png, "x");
        ASSERT_EQ(gray.has_value(), color_type == 0);
        if (!gray) continue;
        EXPECT_EQ(cv::norm(*gray, cv::imdecode(png, cv::IMREAD_UNCHANGED), cv::NORM_INF), 0);
      }
    }
  }
}

TEST(ImageDecoders, RefuseAnImage_WhenItsHeaderIsTooLarge) {
  std::string bmp("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x00\x70\0\0\x00\x70\0\0\1\0\x18\0", 30);
  bmp.resize(200, '\0');
  for (const std::string& text : {std::string("P5 28672 28672 255\n"), bmp}) {
    const auto image = decodeColorImage({reinterpret_cast<const uchar*>(text.data()), text.size()}, "bomb");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message(),
                AllOf(HasSubstr("bomb has 28672x28672 pixels"), HasSubstr("4096x4096")));
  }
  for (const cv::Size size : {cv::Size(8200, 1), cv::Size(5000, 5000)}) {
    for (const char* extension : {".png", ".jpg", ".tif"}) {
      std::vector<uchar> bytes;
      cv::imencode(extension, cv::Mat::zeros(size, CV_8UC3), bytes);
      const auto image = decodeColorImage(bytes, "bomb");
      ASSERT_FALSE(image) << extension;
      EXPECT_THAT(image.error().message(), HasSubstr("4096x4096")) << extension;
    }
  }
}

TEST(ImageDecoders, NameTheDamageAndPrintNothing_WhenBytesAreDamaged) {
  cv::Mat noise(48, 64, CV_8UC3);
  cv::randu(noise, 0, 255);
  std::vector<uchar> png, jpeg;
  cv::imencode(".png", noise, png);
  cv::imencode(".jpg", noise, jpeg);
  png[png.size() / 2] ^= 0x55;
  jpeg[jpeg.size() / 2] = 0xFF;  // an end marker in the middle; libjpeg alone would fill the rest with grey
  jpeg[jpeg.size() / 2 + 1] = 0xD9;
  testing::internal::CaptureStderr();
  for (const std::vector<uchar>& bytes : {png, jpeg}) {
    const auto image = decodeColorImage(bytes, "picture");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().what, testing::StartsWith("picture cannot be decoded: it is damaged ("));
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
}

TEST(ImageDecoders, RefuseAnImage_WhenTruncatedAnywhere) {
  cv::Mat noise(24, 32, CV_16UC1), color(24, 32, CV_8UC3);
  cv::randu(noise, 0, 60000);
  cv::randu(color, 0, 255);
  for (const char* extension : {".png", ".jpg", ".pgm", ".bmp", ".ppm"}) {
    std::vector<uchar> image;
    cv::imencode(extension, std::string(extension) == ".pgm" ? noise : color, image);
    EXPECT_TRUE(decodeColorImage(image, "x")) << extension;
    for (std::size_t length = 0; length < image.size(); ++length) {
      const auto cut = decodeColorImage({image.data(), length}, "picture");
      ASSERT_FALSE(cut) << extension << length << " of " << image.size();
      EXPECT_THAT(cut.error().what, testing::StartsWith("picture ")) << extension << length;
      if (length <= image.size() / 2) continue;
      EXPECT_THAT(cut.error().what, HasSubstr("truncated")) << extension << length;
    }
  }
}

TEST(ImageDecoders, IgnoreTrailingBytes) {
  for (const char* extension : {".png", ".jpg", ".ppm"}) {
    std::vector<uchar> image;
    cv::imencode(extension, cv::Mat(24, 32, CV_8UC3, cv::Scalar(20, 90, 160)), image);
    image.insert(image.end(), 100, 0);
    EXPECT_TRUE(decodeColorImage(image, "x")) << extension;
  }
}

/// Webcams write such padding. A truncation after it is still found.
TEST(ImageDecoders, IgnorePadding_BetweenJpegMarkers) {
  cv::Mat noise(48, 64, CV_8UC3);
  cv::randu(noise, 0, 255);
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", noise, jpeg);
  const cv::Mat expected = cv::imdecode(jpeg, cv::IMREAD_COLOR);
  jpeg.insert(jpeg.begin() + 2, 5, 0);
  const auto padded = decodeColorImage(jpeg, "x");
  ASSERT_TRUE(padded) << padded.error().message();
  EXPECT_EQ(cv::norm(*padded, expected, cv::NORM_INF), 0);
  jpeg.resize(jpeg.size() * 3 / 4);
  const auto cut = decodeColorImage(jpeg, "picture");
  ASSERT_FALSE(cut);
  EXPECT_THAT(cut.error().what, HasSubstr("picture is truncated"));
}

TEST(ReadDepthImage, Fails_WhenABitIsFlipped) {
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
