#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/image/image_file.h"
#include "core/image/jpeg_encoder.h"
#include "core/image/png_decoder.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

cv::Mat noise(int type) {
  cv::Mat image(37, 53, type);
  cv::randu(image, 0, image.depth() == CV_8U ? 256 : 65536);
  return image;
}

std::span<const std::uint8_t> bytesOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

cv::Mat byOpenCv(const std::string& bytes) {
  return cv::imdecode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
}

TEST(EncodePalettePng, ReadsBackAsTheColors) {
  std::vector<std::array<std::uint8_t, 3>> palette{{0, 0, 0}, {128, 0, 0}, {10, 20, 30}};
  cv::Mat indices(17, 23, CV_8UC1);
  cv::randu(indices, 0, 3);
  const std::string png = encodePalettePng(indices, palette);
  EXPECT_EQ(static_cast<int>(png[24]), 8);
  EXPECT_EQ(static_cast<int>(png[25]), 3) << "colour type: palette";
  const cv::Mat shown = cv::imdecode(std::vector<std::uint8_t>(png.begin(), png.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(shown.size(), indices.size());
  for (int y = 0; y < indices.rows; ++y) {
    for (int x = 0; x < indices.cols; ++x) {
      const auto& rgb = palette[indices.at<std::uint8_t>(y, x)];
      ASSERT_EQ(shown.at<cv::Vec3b>(y, x), cv::Vec3b(rgb[2], rgb[1], rgb[0]));
    }
  }
}

TEST(EncodePng, ReadsBackEqual_WithOpenCvAndOwnDecoder) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1}) {
    SCOPED_TRACE(type);
    // Rows of a part of an image are not contiguous.
    for (const cv::Mat& image : {noise(type), noise(type)(cv::Rect(5, 7, 20, 11))}) {
      const std::string png = encodePng(image);
      for (const cv::Mat& read : {byOpenCv(png), decodeAnyPng(bytesOf(png), "x").value()}) {
        ASSERT_EQ(read.type(), type);
        ASSERT_EQ(read.size(), image.size());
        EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0);
      }
    }
  }
}

TEST(EncodeJpeg, EqualsOpenCv_AtTheSameQuality) {
  cv::Mat picture = noise(CV_8UC3);
  cv::GaussianBlur(picture, picture, {9, 9}, 3);
  std::vector<std::uint8_t> expected;
  ASSERT_TRUE(cv::imencode(".jpg", picture, expected, {cv::IMWRITE_JPEG_QUALITY, 90}));
  const std::string jpeg = encodeJpeg(picture, 90);
  // Both use libjpeg-turbo with the same settings.
  EXPECT_EQ(cv::norm(byOpenCv(jpeg), cv::imdecode(expected, cv::IMREAD_COLOR), cv::NORM_INF), 0);
  EXPECT_GT(encodeJpeg(picture, 95).size(), encodeJpeg(picture, 40).size());
}

TEST(EncodeJpeg, Throws_WhenTheImageIsTooWide) {
  EXPECT_THROW(static_cast<void>(encodeJpeg(cv::Mat(1, 70'000, CV_8UC3, cv::Scalar::all(9)), 90)),
               std::runtime_error);
}

TEST(ImageDecoders, ReadPnmBmpAndTiff) {
  const cv::Mat color = noise(CV_8UC3), depth = noise(CV_16UC1);
  for (const char* extension : {".ppm", ".bmp", ".tif"}) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(cv::imencode(extension, color, bytes)) << extension;
    const auto read = decodeColorImage(bytes, "x");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(cv::norm(*read, color, cv::NORM_INF), 0) << extension;
  }
  for (const char* extension : {".pgm", ".tif"}) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(cv::imencode(extension, depth, bytes)) << extension;
    const auto read = decodeGrayImage(bytes, "x");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(cv::norm(*read, depth, cv::NORM_INF), 0) << extension;
  }
  const auto damaged = decodeGrayImage(bytesOf("P2 3 3 255 none"), "a page");
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().what, "a page cannot be decoded: it is damaged or truncated.");
}

}  // namespace
}  // namespace scantrove
