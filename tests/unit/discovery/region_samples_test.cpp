#include "core/discovery/region_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scantrove {
namespace {

const RegionId kBall{3}, kBoard{4};

/// A ball of 10 cm radius at (0, 0, 1), sampled evenly by `points` points.
RegionSamples ballOf(int points) {
  RegionSamples samples;
  for (int i = 0; i < points; ++i) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5F) / static_cast<float>(points);
    const float turn = static_cast<float>(i) * 2.399963F;  // the golden angle
    const float r = std::sqrt(1 - z * z);
    const Eigen::Vector3f normal(r * std::cos(turn), r * std::sin(turn), z);
    samples.add(kBall, Eigen::Vector3f(0, 0, 1) + 0.1F * normal, normal);
  }
  return samples;
}

TEST(RegionSamples, ShapeIsTheSame_WithAnyNumberOfPoints) {
  for (const int points : {100, 511, 513, 20000}) {
    const RegionSamples::Shape ball = ballOf(points).shapeOf({kBall});
    // The outermost 1 % at either end of each axis are ignored: 0.2 (1 - 0.02).
    EXPECT_NEAR(ball.box.size_m[0], 0.196F, 0.006F) << points;
    EXPECT_NEAR(ball.box.size_m[2], 0.196F, 0.006F) << points;
    EXPECT_LT((ball.box.mean - Eigen::Vector3f(0, 0, 1)).norm(), 0.01F) << points;
    EXPECT_NEAR(ball.bulge, 1, 0.01F) << points;  // everywhere p - c is along n
  }
}

TEST(RegionSamples, ShapeOfSeveralRegionsWeighsThemByPoints) {
  RegionSamples samples = ballOf(4000);
  // A board of 40 x 40 cm beside it, of fewer points.
  for (int i = 0; i < 400; ++i) {
    samples.add(kBoard,
                {0.5F + 0.02F * static_cast<float>(i % 20), 0.02F * static_cast<float>(i / 20) - 0.2F, 1},
                {0, 0, 0});
  }
  const RegionSamples::Shape both = samples.shapeOf({kBall, kBoard});
  EXPECT_NEAR(both.box.size_m[0], 0.95F, 0.05F) << "from -0.1 to 0.88, without the outermost 1 %";
  // The ball has ten times as many points, so the mean is near its center.
  EXPECT_LT(both.box.mean.x(), 0.1F);
  EXPECT_EQ(samples.shapeOf({RegionId{99}}).box.size_m, Eigen::Vector3f::Zero());
}

TEST(RegionSamples, PartInViewIsThePartInsideTheVisibleImage) {
  const RegionSamples samples = ballOf(4000);
  const Intrinsics K{500, 500, 319.5F, 239.5F, 640, 480};
  const cv::Rect all(0, 0, 640, 480);
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  EXPECT_EQ(samples.partInView(kBall, K, T_world_camera, all), 1);
  EXPECT_EQ(samples.partInView(RegionId{99}, K, T_world_camera, all), 0);
  // Its center lies on the left edge, so half of the ball is outside, up to perspective.
  T_world_camera.translation().x() = 0.64;
  EXPECT_NEAR(samples.partInView(kBall, K, T_world_camera, all), 0.5F, 0.05F);
  EXPECT_EQ(samples.partInView(kBall, K, T_world_camera, {100, 0, 540, 480}), 0) << "behind a blind strip";
  T_world_camera.translation() = Eigen::Vector3d(0, 0, 2);
  EXPECT_EQ(samples.partInView(kBall, K, T_world_camera, all), 0) << "behind the camera";
}

}  // namespace
}  // namespace scantrove
