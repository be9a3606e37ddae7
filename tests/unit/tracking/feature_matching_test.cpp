#include "core/tracking/feature_matching.h"

#include <gtest/gtest.h>

#include <random>

namespace scantrove::test {
namespace {

constexpr int kBits = 256;
const Intrinsics kFeatureCamera{500, 500, 319.5F, 239.5F, 640, 480};

cv::Mat randomRow(std::mt19937& random) {
  cv::Mat row(1, kBits / 8, CV_8UC1);
  for (int i = 0; i < row.cols; ++i) row.at<std::uint8_t>(i) = static_cast<std::uint8_t>(random());
  return row;
}

cv::Mat withBitsFlipped(const cv::Mat& row, int bits) {
  cv::Mat other = row.clone();
  for (int i = 0; i < bits; ++i) other.at<std::uint8_t>(i / 8) ^= static_cast<std::uint8_t>(1U << (i % 8));
  return other;
}

/// Landmarks in view of a camera, and its features, shifted horizontally by `shift_px`.
struct VisibleLandmarks {
  ColorView view;
  Landmarks landmarks;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();

  explicit VisibleLandmarks(int count, float shift_px = 0) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(60, 580), v(60, 420), z(0.8F, 3);
    T_world_camera.translate(Eigen::Vector3d(0.5, -1, 2))
        .rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
    view.K = kFeatureCamera;
    view.T_color_depth.translate(Eigen::Vector3d(-0.025, 0, 0));
    const Eigen::Isometry3d T_world_color = T_world_camera * view.T_color_depth.inverse();
    for (int i = 0; i < count; ++i) {
      const cv::Point2f pixel(u(random), v(random));
      const Eigen::Vector3f p =
          T_world_color.cast<float>() * kFeatureCamera.backProject(pixel.x, pixel.y, z(random));
      add(p, {pixel.x + shift_px, pixel.y}, randomRow(random));
    }
  }

  void add(const Eigen::Vector3f& p, const cv::Point2f& pixel, const cv::Mat& descriptor) {
    landmarks.points_world.emplace_back(p.x(), p.y(), p.z());
    landmarks.descriptors.push_back(descriptor);
    view.pixels.push_back(pixel);
    view.descriptors.push_back(descriptor);
  }
};

TEST(FeatureMatching, FindsEveryPair) {
  const VisibleLandmarks scene(200, 20);
  for (const auto& matches : {matchAll(scene.view.descriptors, scene.landmarks),
                              matchNear(scene.view, scene.landmarks, scene.T_world_camera)}) {
    ASSERT_EQ(matches.size(), 200U);
    for (const FeatureMatch& match : matches) EXPECT_EQ(match.feature, match.landmark);
  }
}

TEST(FeatureMatching, MatchNearIgnoresAFeature_WhenFartherThanItsRadius) {
  // 0.08 of 640 pixels is 51.2.
  EXPECT_EQ(matchNear(VisibleLandmarks(50, 50).view, VisibleLandmarks(50).landmarks,
                      VisibleLandmarks(50).T_world_camera)
                .size(),
            50U);
  const VisibleLandmarks far(1, 53);
  EXPECT_TRUE(matchNear(far.view, far.landmarks, far.T_world_camera).empty());
  EXPECT_EQ(matchAll(far.view.descriptors, far.landmarks).size(), 1U);
}

TEST(FeatureMatching, MatchNearIgnoresASimilarFeature_WhenFarAway) {
  // A distant second feature resembles the landmark more than its own feature.
  VisibleLandmarks scene(30);
  const cv::Mat descriptor = scene.landmarks.descriptors.row(4).clone();
  withBitsFlipped(descriptor, 10).copyTo(scene.view.descriptors.row(4));
  const cv::Point2f original = scene.view.pixels[4];
  scene.view.pixels.emplace_back(original.x > 320 ? original.x - 200 : original.x + 200, original.y);
  scene.view.descriptors.push_back(descriptor);
  const auto featureOfLandmark4 = [](const std::vector<FeatureMatch>& matches) {
    for (const FeatureMatch& match : matches) {
      if (match.landmark == 4) return match.feature;
    }
    return -1;
  };
  EXPECT_EQ(featureOfLandmark4(matchAll(scene.view.descriptors, scene.landmarks)), 30);
  EXPECT_EQ(featureOfLandmark4(matchNear(scene.view, scene.landmarks, scene.T_world_camera)), 4);
}

TEST(FeatureMatching, PairsAreMutualAndSimilar) {
  VisibleLandmarks scene(1);
  const cv::Mat descriptor = scene.landmarks.descriptors.row(0).clone();
  // Of two features at one pixel, the landmark matches the more similar one; the other has no match.
  scene.view.pixels.push_back(scene.view.pixels[0]);
  scene.view.descriptors.push_back(withBitsFlipped(descriptor, 5));
  for (const int bits : {64, 65}) {
    withBitsFlipped(descriptor, bits).copyTo(scene.view.descriptors.row(0));
    for (const auto& matches : {matchAll(scene.view.descriptors, scene.landmarks),
                                matchNear(scene.view, scene.landmarks, scene.T_world_camera)}) {
      ASSERT_EQ(matches.size(), 1U);
      EXPECT_EQ(matches[0].feature, 1);
    }
  }
  scene.view.pixels.pop_back();
  scene.view.descriptors.pop_back(1);
  EXPECT_TRUE(matchNear(scene.view, scene.landmarks, scene.T_world_camera).empty()) << "65 of 256 differ";
  withBitsFlipped(descriptor, 64).copyTo(scene.view.descriptors.row(0));
  EXPECT_EQ(matchNear(scene.view, scene.landmarks, scene.T_world_camera).size(), 1U) << "64 of 256 differ";
}

TEST(FeatureMatching, FindsNothing_WithoutFeaturesOrLandmarksInView) {
  const VisibleLandmarks scene(5);
  EXPECT_TRUE(matchNear({}, scene.landmarks, scene.T_world_camera).empty());
  EXPECT_TRUE(matchAll({}, scene.landmarks).empty());
  EXPECT_TRUE(matchNear(scene.view, {}, scene.T_world_camera).empty());
  EXPECT_TRUE(matchAll(scene.view.descriptors, {}).empty());
  // Landmarks behind the camera are not in view.
  const Eigen::Isometry3d turned = scene.T_world_camera * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(matchNear(scene.view, scene.landmarks, turned).empty());
}

}  // namespace
}  // namespace scantrove::test
