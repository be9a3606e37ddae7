#include "core/tracking/landmark_pose.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

const Intrinsics kColorCamera{525, 525, 319.5, 239.5, 640, 480};

/// Random points in a room with random descriptors.
Landmarks randomLandmarks(int count, std::uint64_t seed) {
  cv::RNG random(seed);
  Landmarks landmarks;
  for (int i = 0; i < count; ++i)
    landmarks.points_world.emplace_back(random.uniform(-1.5F, 1.5F), random.uniform(-1.0F, 1.0F),
                                        random.uniform(1.5F, 3.5F));
  landmarks.descriptors.create(count, 32, CV_8UC1);
  random.fill(landmarks.descriptors, cv::RNG::UNIFORM, 0, 256);
  return landmarks;
}

/// The view of a camera at `T_world_depth`, with pixel noise and some changed descriptor bits.
ColorView viewOf(const Landmarks& landmarks, const Eigen::Isometry3d& T_world_depth,
                 const Eigen::Isometry3d& T_color_depth, double noise_px) {
  cv::RNG random(3);
  ColorView view;
  view.K = kColorCamera;
  view.T_color_depth = T_color_depth;
  const Eigen::Isometry3d T_color_world = T_color_depth * T_world_depth.inverse();
  for (std::size_t i = 0; i < landmarks.points_world.size(); ++i) {
    const cv::Point3f& at = landmarks.points_world[i];
    const Eigen::Vector3d p = T_color_world * Eigen::Vector3f(at.x, at.y, at.z).cast<double>();
    if (p.z() < 0.3) continue;
    const double u =
        double{kColorCamera.fx} * p.x() / p.z() + double{kColorCamera.cx} + random.gaussian(noise_px);
    const double v =
        double{kColorCamera.fy} * p.y() / p.z() + double{kColorCamera.cy} + random.gaussian(noise_px);
    if (u < 0 || v < 0 || u >= 640 || v >= 480) continue;
    view.pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
    cv::Mat descriptor = landmarks.descriptors.row(static_cast<int>(i)).clone();
    for (int bit = 0; bit < 20; ++bit) {
      auto& byte = descriptor.at<std::uint8_t>(random.uniform(0, 32));
      byte = static_cast<std::uint8_t>(byte ^ (1U << static_cast<unsigned>(random.uniform(0, 8))));
    }
    view.descriptors.push_back(descriptor);
  }
  return view;
}

void expectNear(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth, double far_m,
                double far_deg) {
  const Eigen::Isometry3d error = truth.inverse() * found;
  EXPECT_LT(error.translation().norm(), far_m);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle() / kDegree, far_deg);
}

TEST(Locate, GivesThePoseOfTheDepthCamera) {
  const Landmarks landmarks = randomLandmarks(300, 1);
  const Eigen::Isometry3d T_color_depth = pose(1, 2, 0, -0.025, 0.002, 0.001);
  for (const Eigen::Isometry3d& truth : {pose(0, 0, 0, 0, 0, 0), pose(10, -20, 15, 0.3, 0.1, -0.2)}) {
    const auto found = locate(viewOf(landmarks, truth, T_color_depth, 0.5), landmarks);
    ASSERT_TRUE(found);
    EXPECT_GT(found->seen.pixels.size(), 100U);
    EXPECT_GT(found->seen.cells(), 20);
    expectNear(found->T_world_camera, truth, 0.005, 0.15);
  }
}

TEST(Locate, FindsThePose_WithTwiceAsManyWrongMatches) {
  Landmarks landmarks = randomLandmarks(450, 2);
  const Eigen::Isometry3d truth = pose(5, 10, 0, 0.1, 0, 0.2);
  const ColorView view = viewOf(landmarks, truth, Eigen::Isometry3d::Identity(), 0.5);
  cv::RNG random(4);
  for (std::size_t i = 0; i < landmarks.points_world.size(); ++i) {  // two of three are displaced
    if (i % 3 != 0) landmarks.points_world[i].x += random.uniform(0.3F, 2.0F);
  }
  const auto found = locate(view, landmarks);
  ASSERT_TRUE(found);
  expectNear(found->T_world_camera, truth, 0.01, 0.3);
}

TEST(Locate, FindsNothing_WithOtherLandmarks) {
  const ColorView view =
      viewOf(randomLandmarks(500, 1), pose(0, 0, 0, 0, 0, 0), Eigen::Isometry3d::Identity(), 0.5);
  EXPECT_FALSE(locate(view, randomLandmarks(500, 9)));
  EXPECT_FALSE(locate(view, Landmarks{}));
  EXPECT_FALSE(locate(ColorView{}, randomLandmarks(500, 9)));
}

TEST(Locate, IsDeterministic) {
  const Landmarks landmarks = randomLandmarks(300, 1);
  const ColorView view = viewOf(landmarks, pose(3, 4, 5, 0.1, 0, 0), Eigen::Isometry3d::Identity(), 1);
  const auto first = locate(view, landmarks);
  const auto second = locate(view, landmarks);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_world_camera.matrix(), second->T_world_camera.matrix());
}

}  // namespace
}  // namespace scantrove::test
