#include "core/dataset/upright_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace scantrove {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Points in a box of 0.6 x 0.3 x 0.2 m around (1, -2, 0.5), turned by `yaw_deg`.
std::vector<Eigen::Vector3f> boxPoints(double yaw_deg) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  const Eigen::AngleAxisf turn(static_cast<float>(yaw_deg * kDegree), Eigen::Vector3f::UnitZ());
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 6000; ++i) {
    Eigen::Vector3f p(0.6F * unit(random), 0.3F * unit(random), 0.2F * unit(random));
    const int face = i % 3;  // on a face, as surfaces are
    p[face] = (p[face] > 0 ? 0.5F : -0.5F) * Eigen::Vector3f(0.6F, 0.3F, 0.2F)[face];
    points.push_back(Eigen::Vector3f(1, -2, 0.5F) + turn * p);
  }
  return points;
}

TEST(FitUprightBox, RecoversABox_AtAnyYaw) {
  for (const double yaw_deg : {0.0, 17.0, 45.0, 89.5, 130.25, 179.0}) {
    const UprightBox box = fitUprightBox(boxPoints(yaw_deg));
    EXPECT_LT((box.center - Eigen::Vector3d(1, -2, 0.5)).norm(), 0.004) << yaw_deg;
    EXPECT_LT((box.size - Eigen::Vector3d(0.6, 0.3, 0.2)).cwiseAbs().maxCoeff(), 0.008) << yaw_deg;
    const double difference = std::remainder(box.yaw_rad / kDegree - yaw_deg, 180.0);
    EXPECT_NEAR(difference, 0, 0.6) << yaw_deg;
    EXPECT_TRUE(box.yaw_rad >= 0 && box.yaw_rad < std::numbers::pi);
  }
}

TEST(FitUprightBox, IgnoresStrayPoints) {
  std::vector<Eigen::Vector3f> points = boxPoints(30);
  for (int i = 0; i < 15; ++i) points.emplace_back(4, 4, 4);
  EXPECT_LT((fitUprightBox(points).size - Eigen::Vector3d(0.6, 0.3, 0.2)).cwiseAbs().maxCoeff(), 0.012);
}

TEST(FitUprightBox, KeepsYawZero_ForRoundObjects) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 7200; ++i) {
    const auto angle = static_cast<float>(i * kDegree / 20);
    points.emplace_back(std::cos(angle), std::sin(angle), 0.001F * static_cast<float>(i % 100));
  }
  const UprightBox box = fitUprightBox(points);
  EXPECT_NEAR(std::remainder(box.yaw_rad, std::numbers::pi / 2), 0, 1e-9);
  EXPECT_NEAR(box.size.x(), 2, 0.01);
}

TEST(FitUprightBox, HasNoSize_WithoutExtent) {
  EXPECT_TRUE(fitUprightBox({}).size.isZero());
  const std::vector<Eigen::Vector3f> one{{1, 2, 3}};
  EXPECT_TRUE(fitUprightBox(one).size.isZero());
  EXPECT_LT((fitUprightBox(one).center - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
}

TEST(UprightBox, CornersGoCounterClockwiseFromAbove) {
  const UprightBox box{{1, 1, 0}, {2, 1, 1}, 90 * kDegree};
  const auto corners = box.levelCorners();
  EXPECT_LT((corners[0] - Eigen::Vector3d(0.5, 2, 0)).norm(), 1e-9);
  EXPECT_LT((corners[1] - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT((corners[2] - Eigen::Vector3d(1.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT((corners[3] - Eigen::Vector3d(1.5, 2, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace scantrove
