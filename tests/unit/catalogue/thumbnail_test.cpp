#include "core/catalogue/thumbnail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

cv::Mat texture(const cv::Size& size) {
  cv::RNG random(4);
  cv::Mat small(6, 6, CV_8UC3), image;
  random.fill(small, cv::RNG::UNIFORM, 0, 256);
  cv::resize(small, image, size, 0, 0, cv::INTER_LINEAR);
  return image;
}

cv::Mat leftHalf(const cv::Size& size) {
  cv::Mat mask(size, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(0, 0, size.width / 2, size.height)).setTo(255);
  return mask;
}

TEST(Thumbnail, IsNormalizedInsideTheMaskAndZeroOutside) {
  for (const cv::Size size : {cv::Size(32, 32), cv::Size(200, 90), cv::Size(10, 14)}) {
    const std::optional<Thumbnail> thumbnail = makeThumbnail(texture(size), leftHalf(size));
    ASSERT_TRUE(thumbnail);
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0, squares = 0;
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
          const double value = thumbnail->fine[c * 1024 + static_cast<std::size_t>(y * 32 + x)] / 32.0;
          if (x < 14) sum += value, squares += value * value;
          if (x > 18) {
            EXPECT_EQ(value, 0);
          }
        }
      }
      EXPECT_NEAR(sum / (14 * 32), 0, 0.35) << size;  // the two blended columns hold the rest
      EXPECT_NEAR(squares / (14 * 32), 1, 0.35) << size;
    }
  }
}

TEST(Thumbnail, IgnoresTheBackground) {
  const cv::Size size(60, 40);
  cv::Mat other = texture(size);
  other(cv::Rect(30, 0, 30, 40)).setTo(cv::Scalar(255, 0, 200));
  EXPECT_EQ(makeThumbnail(texture(size), leftHalf(size))->fine, makeThumbnail(other, leftHalf(size))->fine);
}

TEST(Thumbnail, IgnoresContrastAndKeepsTheMeanColor) {
  const cv::Size size(64, 64);
  const cv::Mat mask(size, CV_8UC1, cv::Scalar(255));
  // In grey, CIELAB's L depends on one value, nearly linearly over a small range.
  cv::Mat gray, half;
  cv::cvtColor(texture(size), gray, cv::COLOR_BGR2GRAY);
  gray.convertTo(half, CV_8U, 0.25, 100);
  gray.convertTo(gray, CV_8U, 0.5, 70);
  cv::cvtColor(half, half, cv::COLOR_GRAY2BGR);
  cv::cvtColor(gray, gray, cv::COLOR_GRAY2BGR);
  const Thumbnail a = *makeThumbnail(gray, mask), b = *makeThumbnail(half, mask);
  double difference = 0;
  for (std::size_t i = 0; i < 1024; ++i) difference += std::abs(a.fine[i] - b.fine[i]) / 32.0;
  EXPECT_LT(difference / 1024, 0.15);
  const Thumbnail red = *makeThumbnail(cv::Mat(size, CV_8UC3, cv::Scalar(0, 0, 255)), mask);
  EXPECT_LT((red.mean_lab - Eigen::Vector3f(53.2F, 80.1F, 67.2F)).norm(), 1.0F);  // CIELAB of sRGB red
}

TEST(Thumbnail, IsZero_WhenTheObjectIsUniform) {
  const cv::Mat gray(50, 40, CV_8UC3, cv::Scalar(120, 120, 120));
  const Thumbnail thumbnail = *makeThumbnail(gray, cv::Mat(gray.size(), CV_8UC1, cv::Scalar(255)));
  for (const std::int8_t value : thumbnail.fine) EXPECT_EQ(value, 0);
}

TEST(Thumbnail, IsNone_WithoutColorOrMaskedPixels) {
  const cv::Mat color = texture({20, 20});
  EXPECT_FALSE(makeThumbnail(color, cv::Mat(20, 20, CV_8UC1, cv::Scalar(0))));
  EXPECT_FALSE(makeThumbnail(cv::Mat(), cv::Mat()));
  EXPECT_FALSE(makeThumbnail(cv::Mat(), cv::Mat(20, 20, CV_8UC1, cv::Scalar(255))));
}

}  // namespace
}  // namespace scantrove
