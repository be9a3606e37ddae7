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

/// Landmarks in sight of a camera, and what it sees of them `shift_px` beside.
struct Sight {
  ColorView view;
  Landmarks landmarks;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();

  explicit Sight(int count, float shift_px = 0) {
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

TEST(FeatureMatching, FindsEveryPartner) {
  const Sight sight(200, 20);
  for (const auto& matches : {matchAll(sight.view.descriptors, sight.landmarks),
                              matchNear(sight.view, sight.landmarks, sight.T_world_camera)}) {
    ASSERT_EQ(matches.size(), 200U);
    for (const FeatureMatch& match : matches) EXPECT_EQ(match.feature, match.landmark);
  }
}

TEST(FeatureMatching, NearMeansNear) {
  // 0.08 of 640 pixels is 51.2.
  EXPECT_EQ(matchNear(Sight(50, 50).view, Sight(50).landmarks, Sight(50).T_world_camera).size(), 50U);
  const Sight far(1, 53);
  EXPECT_TRUE(matchNear(far.view, far.landmarks, far.T_world_camera).empty());
  EXPECT_EQ(matchAll(far.view.descriptors, far.landmarks).size(), 1U);
}

TEST(FeatureMatching, WhatLooksAlikeElsewhereDoesNotConfuse) {
  // A second feature, far away, looks even more like the landmark than its own.
  Sight sight(30);
  const cv::Mat descriptor = sight.landmarks.descriptors.row(4).clone();
  withBitsFlipped(descriptor, 10).copyTo(sight.view.descriptors.row(4));
  const cv::Point2f own = sight.view.pixels[4];
  sight.view.pixels.emplace_back(own.x > 320 ? own.x - 200 : own.x + 200, own.y);
  sight.view.descriptors.push_back(descriptor);
  const auto partnerOf4 = [](const std::vector<FeatureMatch>& matches) {
    for (const FeatureMatch& match : matches) {
      if (match.landmark == 4) return match.feature;
    }
    return -1;
  };
  EXPECT_EQ(partnerOf4(matchAll(sight.view.descriptors, sight.landmarks)), 30);
  EXPECT_EQ(partnerOf4(matchNear(sight.view, sight.landmarks, sight.T_world_camera)), 4);
}

TEST(FeatureMatching, PartnersAreMutualAndAlike) {
  Sight sight(1);
  const cv::Mat descriptor = sight.landmarks.descriptors.row(0).clone();
  // Two features at one place: the landmark takes the one that is more like it, and the other has none.
  sight.view.pixels.push_back(sight.view.pixels[0]);
  sight.view.descriptors.push_back(withBitsFlipped(descriptor, 5));
  for (const int bits : {64, 65}) {
    withBitsFlipped(descriptor, bits).copyTo(sight.view.descriptors.row(0));
    for (const auto& matches : {matchAll(sight.view.descriptors, sight.landmarks),
                                matchNear(sight.view, sight.landmarks, sight.T_world_camera)}) {
      ASSERT_EQ(matches.size(), 1U);
      EXPECT_EQ(matches[0].feature, 1);
    }
  }
  sight.view.pixels.pop_back();
  sight.view.descriptors.pop_back(1);
  EXPECT_TRUE(matchNear(sight.view, sight.landmarks, sight.T_world_camera).empty()) << "65 of 256 differ";
  withBitsFlipped(descriptor, 64).copyTo(sight.view.descriptors.row(0));
  EXPECT_EQ(matchNear(sight.view, sight.landmarks, sight.T_world_camera).size(), 1U) << "64 of 256 differ";
}

TEST(FeatureMatching, WithNothingThereIsNothing) {
  const Sight sight(5);
  EXPECT_TRUE(matchNear({}, sight.landmarks, sight.T_world_camera).empty());
  EXPECT_TRUE(matchAll({}, sight.landmarks).empty());
  EXPECT_TRUE(matchNear(sight.view, {}, sight.T_world_camera).empty());
  EXPECT_TRUE(matchAll(sight.view.descriptors, {}).empty());
  // Landmarks behind the camera are not in sight.
  const Eigen::Isometry3d turned = sight.T_world_camera * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(matchNear(sight.view, sight.landmarks, turned).empty());
}

}  // namespace
}  // namespace scantrove::test
