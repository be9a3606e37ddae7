#include "core/tracking/color_view.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

const Intrinsics kDepth{525, 525, 319.5, 239.5, 640, 480};
const Intrinsics kWorking = kDepth.resizedTo(320, 240);

/// An image of random squares with many corners.
RgbdFrame patchwork() {
  RgbdFrame frame;
  cv::Mat patches(24, 32, CV_8UC3);
  cv::RNG(7).fill(patches, cv::RNG::UNIFORM, 0, 256);
  cv::resize(patches, frame.color, {640, 480}, 0, 0, cv::INTER_NEAREST);
  return frame;
}

/// Vertices (world frame) of a plane z = 2 + slope * x in the frame of a camera at `T_world_depth`; the left
/// half is `step_m` nearer.
std::vector<cl_float4> plane(const Eigen::Isometry3d& T_world_depth, float slope, float step_m) {
  std::vector<cl_float4> vertices;
  for (int v = 0; v < kWorking.height; ++v) {
    for (int u = 0; u < kWorking.width; ++u) {
      const Eigen::Vector3f ray = kWorking.backProject(static_cast<float>(u), static_cast<float>(v), 1);
      const float z = 2 / (1 - slope * ray.x()) - (u < kWorking.width / 2 ? step_m : 0);
      const Eigen::Vector3d p = T_world_depth * (z * ray).cast<double>();
      vertices.push_back(
          {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1}});
    }
  }
  return vertices;
}

TEST(LandmarksOf, PlacesFeaturesOnTheSurface) {
  RgbdFrame frame = patchwork();
  FeatureFinder finder;
  for (const bool is_registered : {true, false}) {
    if (!is_registered)
      frame.color_camera = ColorCamera{{530, 530, 315, 245, 640, 480}, pose(0, 1, 0, -0.025, 0, 0)};
    const Eigen::Isometry3d T = pose(10, 20, 30, 1, 2, 3);
    const ColorView view = finder.find(grayViewOf(frame, kDepth));
    ASSERT_GT(view.pixels.size(), 500U);
    const Landmarks landmarks = landmarksOf(view, T, plane(T, 0.3F, 0));
    EXPECT_GT(landmarks.points_world.size(), view.pixels.size() * 8 / 10);
    ASSERT_EQ(landmarks.descriptors.rows, static_cast<int>(landmarks.points_world.size()));
    for (const cv::Point3f& point : landmarks.points_world) {
      const Eigen::Vector3d p = T.inverse() * Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
      // Two pixels on this slope differ by 2 px * 0.3 * 2 m / 525.
      EXPECT_NEAR(p.z(), 2 + 0.3 * p.x(), 0.004);
    }
  }
}

TEST(GrayViewOf, HasTheCameraOfItsFrame_WhenThatHasItsOwn) {
  RgbdFrame frame = patchwork();
  EXPECT_EQ(grayViewOf(frame, kDepth).K, kDepth.resizedTo(frame.color.cols, frame.color.rows));
  frame.intrinsics = Intrinsics{540, 541, 318, 241, 640, 480};
  EXPECT_EQ(grayViewOf(frame, kDepth).K, frame.intrinsics->resizedTo(frame.color.cols, frame.color.rows));
  const Intrinsics K_color{530, 530, 315, 245, frame.color.cols, frame.color.rows};
  frame.color_camera = ColorCamera{K_color, Eigen::Isometry3d::Identity()};
  EXPECT_EQ(grayViewOf(frame, kDepth).K, K_color) << "a separate colour camera";
}

TEST(LandmarksOf, SkipsFeaturesAtOutlines) {
  FeatureFinder finder;
  const ColorView view = finder.find(grayViewOf(patchwork(), kDepth));
  const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Landmarks landmarks = landmarksOf(view, T, plane(T, 0, 0.5F));
  ASSERT_GT(landmarks.points_world.size(), 100U);
  for (const cv::Point3f& point : landmarks.points_world) EXPECT_GT(std::abs(point.x / point.z), 1.0 / 525);
}

TEST(FeatureFinder, FindsNothing_WithoutImageOrSurface) {
  FeatureFinder finder;
  EXPECT_TRUE(finder.find(grayViewOf(RgbdFrame{}, kDepth)).pixels.empty());
  RgbdFrame dark;
  dark.color = cv::Mat::zeros(480, 640, CV_8UC3);
  EXPECT_TRUE(finder.find(grayViewOf(dark, kDepth)).pixels.empty());
  const ColorView view = finder.find(grayViewOf(patchwork(), kDepth));
  const std::vector<cl_float4> no_surface(static_cast<std::size_t>(kWorking.pixels()), cl_float4{});
  EXPECT_TRUE(landmarksOf(view, Eigen::Isometry3d::Identity(), no_surface).points_world.empty());
}

}  // namespace
}  // namespace scantrove::test
