#include "core/fusion/color_projection.h"

#include <gtest/gtest.h>

#include <vector>

namespace scantrove {
namespace {

const Intrinsics kDepth{300, 300, 160, 120, 320, 240};
constexpr auto kPixels = std::size_t{320} * 240;

/// 25 mm to the right of the depth camera.
ColorCamera cameraToTheRight() {
  ColorCamera camera{{1050, 1040, 640, 512, 1280, 1024}};
  camera.T_color_depth.translation().x() = -0.025;
  return camera;
}

/// A wall at 1 m, and a second wall at 0.5 m in front of its right half.
RenderedView halfHidden() {
  RenderedView view{kDepth};
  for (int v = 0; v < kDepth.height; ++v) {
    for (int u = 0; u < kDepth.width; ++u) {
      const float z = u >= 160 ? 0.5F : 1.0F;
      view.vertices_world.push_back(
          kDepth.backProject(static_cast<float>(u), static_cast<float>(v), z).homogeneous());
    }
  }
  return view;
}

cv::Point2f pixelAt(const SurfaceInColor& seen, const cv::Size& size, int u, int v) {
  const cv::Vec2f pixel = pixelsOf(seen.places, size).at<cv::Vec2f>(v, u);
  return {pixel[0], pixel[1]};
}

TEST(LocateInColor, ProjectsTheSurfaceIntoTheColorCamera) {
  RenderedView view{kDepth};
  view.vertices_world.assign(kPixels, Eigen::Vector4f::Zero());
  view.vertices_world[320 * 90 + 200] = {0.1F, -0.05F, 2, 1};
  const SurfaceInColor seen = locateInColor(cameraToTheRight(), view);
  const cv::Point2f pixel = pixelAt(seen, {1280, 1024}, 200, 90);
  EXPECT_NEAR(pixel.x, 1050 * (0.1 - 0.025) / 2 + 640, 1e-3);  // 679.375
  EXPECT_NEAR(pixel.y, 1040 * -0.05 / 2 + 512, 1e-3);          // 486
  EXPECT_EQ(seen.hidden.at<std::uint8_t>(90, 200), 0);
  // For a colour image of half the size.
  EXPECT_NEAR(pixelAt(seen, {640, 512}, 200, 90).x, (679.375 + 0.5) / 2 - 0.5, 1e-3);
  // Pixels without surface are at infinity: (60 / 300, 30 / 300).
  EXPECT_NEAR(pixelAt(seen, {1280, 1024}, 220, 150).x, 1050 * 0.2 + 640, 1e-3);
  EXPECT_NEAR(pixelAt(seen, {1280, 1024}, 220, 150).y, 1040 * 0.1 + 512, 1e-3);
}

TEST(LocateInColor, AppliesRotationAndPose) {
  ColorCamera camera = cameraToTheRight();
  camera.T_color_depth.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  RenderedView view{kDepth};
  view.T_world_camera.translation() << 5, 6, 7;
  view.T_world_camera.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  view.vertices_world.assign(kPixels, Eigen::Vector4f::Zero());
  // (0.1, -0.05, 2) in the depth camera; its y is z and its z is -y of the world.
  view.vertices_world[0] = {5.1F, 6 - 2.0F, 7 - 0.05F, 1};
  const SurfaceInColor seen = locateInColor(camera, view);
  // In the colour camera x becomes y and y becomes -x: (0.05 - 0.025, 0.1, 2).
  EXPECT_NEAR(pixelAt(seen, {1280, 1024}, 0, 0).x, 1050 * 0.025 / 2 + 640, 1e-2);
  EXPECT_NEAR(pixelAt(seen, {1280, 1024}, 0, 0).y, 1040 * 0.1 / 2 + 512, 1e-2);
}

TEST(LocateInColor, ScalesPixels_WhenColorIsRegistered) {
  const SurfaceInColor seen = locateInColor(std::nullopt, {kDepth});
  EXPECT_NEAR(pixelAt(seen, {640, 480}, 100, 50).x, 200.5, 1e-4);
  EXPECT_NEAR(pixelAt(seen, {640, 480}, 100, 50).y, 100.5, 1e-4);
  EXPECT_EQ(cv::countNonZero(seen.hidden), 0);
}

TEST(LocateInColor, HidesOccludedSurface) {
  const SurfaceInColor seen = locateInColor(cameraToTheRight(), halfHidden());
  // The near edge projects to (0 - 0.025) / 0.5 = -0.05. The far wall projects there at x = -0.025, so x
  // between -0.025 and 0 is hidden: 7.5 depth pixels.
  for (const int v : {20, 120, 220}) {
    EXPECT_EQ(seen.hidden.at<std::uint8_t>(v, 140), 0);
    EXPECT_EQ(seen.hidden.at<std::uint8_t>(v, 149), 0);
    EXPECT_EQ(seen.hidden.at<std::uint8_t>(v, 155), 255);
    EXPECT_EQ(seen.hidden.at<std::uint8_t>(v, 159), 255);
    EXPECT_EQ(seen.hidden.at<std::uint8_t>(v, 160), 0);
    EXPECT_EQ(seen.hidden.at<std::uint8_t>(v, 300), 0);
  }
}

TEST(LocateInColor, HidesSurface_OutsideTheColorImage) {
  ColorCamera camera = cameraToTheRight();
  camera.K.cx = -100;  // its left edge at x / z = 100 / 1050
  const SurfaceInColor seen = locateInColor(camera, halfHidden());
  EXPECT_EQ(seen.hidden.at<std::uint8_t>(120, 160 + 40), 255);  // 40 / 300 - 0.05 = 0.083
  EXPECT_EQ(seen.hidden.at<std::uint8_t>(120, 160 + 48), 0);    // 48 / 300 - 0.05 = 0.11
  camera.T_color_depth.translation().z() = -3;                  // all lies behind it
  EXPECT_EQ(cv::countNonZero(locateInColor(camera, halfHidden()).hidden), static_cast<int>(kPixels));
}

}  // namespace
}  // namespace scantrove
