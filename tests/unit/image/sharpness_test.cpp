#include "core/image/sharpness.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace scantrove::test {
namespace {

/// Squares of random grey, 12 pixels each: steps in both directions.
cv::Mat checkered(double lowest, double highest) {
  cv::RNG random(5);
  cv::Mat small(20, 20, CV_8UC3), image;
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x)
      small.at<cv::Vec3b>(y, x) =
          cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(random.uniform(lowest, highest)));
  }
  cv::resize(small, image, {240, 240}, 0, 0, cv::INTER_NEAREST);
  return image;
}

cv::Mat blurredAcross(const cv::Mat& image, int pixels) {
  cv::Mat blurred;
  cv::blur(image, blurred, {pixels, 1});
  return blurred;
}

TEST(SharpnessOf, IsAnEighth_ForSteps) {
  // A step between squares at least 8 apart counts in one pair of neighbours and in 8 pairs of pixels 8
  // apart.
  EXPECT_NEAR(sharpnessOf(checkered(0, 255)), 1 / 8.0, 0.01);
}

TEST(SharpnessOf, DoesNotDependOnContrast) {
  EXPECT_NEAR(sharpnessOf(checkered(90, 165)), sharpnessOf(checkered(0, 255)), 0.01);
}

TEST(SharpnessOf, FallsWithBlur_EvenInOneDirection) {
  const cv::Mat image = checkered(0, 255);
  const float sharp = sharpnessOf(image);
  // A step of height 1 over n pixels has n steps of 1 / n: 1 / n of the squared differences.
  EXPECT_LT(sharpnessOf(blurredAcross(image, 3)), 0.5 * sharp);
  EXPECT_LT(sharpnessOf(blurredAcross(image, 7)), 0.25 * sharp);
  EXPECT_GT(sharpnessOf(blurredAcross(image, 7)), 0);
}

TEST(SharpnessOf, IsUnknown_WithoutContrast) {
  EXPECT_EQ(sharpnessOf(cv::Mat(100, 100, CV_8UC3, cv::Scalar::all(80))), 0);
  EXPECT_EQ(sharpnessOf(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(80))), 0) << "too small for a difference";
}

TEST(SharpnessOfSquares, TellsBlurredSquaresFromSharpOnes_DespiteNoise) {
  cv::Mat image = checkered(0, 255);
  blurredAcross(image(cv::Rect(120, 0, 120, 240)), 7).copyTo(image(cv::Rect(120, 0, 120, 240)));
  image.rowRange(180, 240) = cv::Scalar::all(128);  // uniform: shows the noise
  cv::Mat noise(image.size(), CV_16SC3);
  cv::RNG(7).fill(noise, cv::RNG::NORMAL, 0, 3);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  const cv::Mat sharpness = sharpnessOfSquares(image, 60);
  ASSERT_EQ(sharpness.size(), cv::Size(4, 4));
  for (int y = 0; y < 3; ++y) {
    EXPECT_GT(sharpness.at<float>(y, 0), 0.08F) << y;
    EXPECT_LT(sharpness.at<float>(y, 3), 0.03F) << y;
    EXPECT_GT(sharpness.at<float>(y, 3), 0) << y;
  }
  for (int x = 0; x < 4; ++x) EXPECT_EQ(sharpness.at<float>(3, x), 0) << "no contrast";
}

}  // namespace
}  // namespace scantrove::test
