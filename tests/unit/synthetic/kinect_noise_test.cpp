#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/synthetic/kinect_noise.h"

namespace scantrove::synthetic {
namespace {

const Intrinsics kK{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};

cv::Mat constantImage(float value) { return {480, 640, CV_32FC1, cv::Scalar(value)}; }

struct Statistics {
  double mean = 0, deviation = 0;
  int count = 0;
};
Statistics statisticsOf(const cv::Mat& z) {
  Statistics s;
  double sum = 0;
  double squares = 0;
  for (int v = 0; v < z.rows; ++v) {
    for (int u = 0; u < z.cols; ++u) {
      const double x = z.at<float>(v, u);
      if (x > 0) {
        sum += x;
        squares += x * x;
        ++s.count;
      }
    }
  }
  s.mean = sum / s.count;
  s.deviation = std::sqrt(squares / s.count - s.mean * s.mean);
  return s;
}

class KinectNoiseAtDepthTest : public testing::TestWithParam<float> {};

TEST_P(KinectNoiseAtDepthTest, SpreadIsAxialNoisePlusQuantisation) {
  const float z = GetParam();
  const KinectModel model;
  const Statistics s = statisticsOf(measureDepth(constantImage(z), constantImage(1), kK, model, 5, 0));
  const double step_m = z * z * model.disparity_step_px / (model.focal_px * model.baseline_m);
  const double expected = std::sqrt(model.sigma(z) * model.sigma(z) + step_m * step_m / 12);
  // 300,000 samples: the estimate is accurate to 0.2 %; a step wider than sigma adds some percent.
  EXPECT_NEAR(s.deviation, expected, 0.12 * expected);
  EXPECT_NEAR(s.mean, z, 0.2 * expected);
  EXPECT_EQ(s.count, 640 * 480) << "a wall seen straight on has no holes";
}
INSTANTIATE_TEST_SUITE_P(Depths, KinectNoiseAtDepthTest, testing::Values(0.6F, 1.0F, 1.5F, 2.0F, 3.0F, 4.5F));

TEST(KinectNoise, ReadingsLieOnTheDisparityGrid) {
  const KinectModel model;
  const cv::Mat z = measureDepth(constantImage(1.3F), constantImage(1), kK, model, 1, 2);
  for (int v = 0; v < 480; v += 7) {
    for (int u = 0; u < 640; u += 7) {
      const double steps = model.focal_px * model.baseline_m / z.at<float>(v, u) / model.disparity_step_px;
      ASSERT_NEAR(steps, std::round(steps), 1e-3);
    }
  }
}

TEST(KinectNoise, ProjectorShadowLiesLeftOfNearObjects) {
  cv::Mat z = constantImage(2.0F);
  z(cv::Rect(300, 150, 100, 200)).setTo(1.0F);
  const KinectModel model;
  const cv::Mat shadow = projectorShadow(z, kK, model);
  const int width = static_cast<int>(std::lround(kK.fx * model.baseline_m * (1 / 1.0 - 1 / 2.0)));
  EXPECT_NEAR(cv::countNonZero(shadow.row(250)), width, 2);
  EXPECT_EQ(cv::countNonZero(shadow(cv::Rect(300 - width + 1, 160, width - 2, 180))), (width - 2) * 180);
  EXPECT_EQ(cv::countNonZero(shadow(cv::Rect(300, 0, 340, 480))), 0)
      << "nothing on the object or to its right";
  EXPECT_EQ(cv::countNonZero(shadow.row(100)), 0);
  const cv::Mat measured = measureDepth(z, constantImage(1), kK, model, 1, 0);
  EXPECT_EQ(cv::countNonZero(measured(cv::Rect(300 - width + 1, 160, width - 2, 180))), 0);
}

TEST(KinectNoise, EdgesAreRagged) {
  cv::Mat z = constantImage(2.0F);
  z(cv::Rect(300, 0, 340, 480)).setTo(1.0F);
  KinectModel model;
  model.baseline_m = 1e-6;  // no shadow, so that only the edge has an effect
  model.disparity_step_px = 1e-9;
  const cv::Mat measured = measureDepth(z, constantImage(1), kK, model, 1, 0);
  int dropped = 0;
  int displaced = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 295; u < 305; ++u) {
      const float reading_m = measured.at<float>(v, u);
      dropped += reading_m == 0 ? 1 : 0;
      displaced += reading_m > 0 && std::abs(reading_m - z.at<float>(v, u)) > 0.5F ? 1 : 0;
    }
  }
  EXPECT_GT(dropped, 30);
  EXPECT_GT(displaced, 60);
  EXPECT_LT(dropped + displaced, 480 * 2) << "only the pixels next to the edge";
}

TEST(KinectNoise, LosesReadings_WhenSurfacesAreGrazing) {
  const auto seen = [](float cosine) {
    return cv::countNonZero(measureDepth(constantImage(1.5F), constantImage(cosine), kK, {}, 1, 0));
  };
  EXPECT_EQ(seen(0.5F), 640 * 480);
  EXPECT_LT(seen(0.18F), 640 * 480 * 9 / 10);
  EXPECT_GT(seen(0.18F), 640 * 480 / 10);
  EXPECT_EQ(seen(0.05F), 0);
}

TEST(KinectNoise, HasNoReading_WhenTooNearTooFarOrMissing) {
  for (const float z : {0.0F, 0.3F, 9.0F}) {
    EXPECT_EQ(cv::countNonZero(measureDepth(constantImage(z), constantImage(1), kK, {}, 1, 0)), 0) << z;
  }
}

TEST(KinectNoise, IsEqualOnly_WhenSeedAndFrameAreEqual) {
  const auto measure = [](std::uint32_t seed, std::uint32_t frame) {
    return measureDepth(constantImage(1.5F), constantImage(1), kK, {}, seed, frame);
  };
  const auto differing = [](const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a != b); };
  EXPECT_EQ(differing(measure(1, 4), measure(1, 4)), 0);
  EXPECT_GT(differing(measure(1, 4), measure(2, 4)), 100000);
  EXPECT_GT(differing(measure(1, 4), measure(1, 5)), 100000);
}

TEST(KinectNoise, ColorNoiseHasTheRequestedSpread) {
  cv::Mat gray(480, 640, CV_8UC3, cv::Scalar(120, 120, 120));
  addColorNoise(gray, 3.0, 1, 0);
  double sum = 0;
  double squares = 0;
  for (int v = 0; v < 480; ++v) {
    for (int i = 0; i < 640 * 3; ++i) {
      const double d = gray.ptr<std::uint8_t>(v)[i] - 120.0;
      sum += d;
      squares += d * d;
    }
  }
  const double count = 480.0 * 640 * 3;
  EXPECT_NEAR(sum / count, 0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 3.0, 0.1);
}

}  // namespace
}  // namespace scantrove::synthetic
