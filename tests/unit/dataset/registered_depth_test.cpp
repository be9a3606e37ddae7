#include "core/dataset/registered_depth.h"

#include <gtest/gtest.h>

#include "core/texturing/depth_raster.h"
#include "tests/unit/dataset/scanned_scene.h"

namespace scantrove::test {
namespace {

KeyFrameInfo firstFrame(ScannedScene& scene) { return scene.keyFrames(false)->front(); }

TEST(RegisterDepth, ReturnsTheSameDepth_WhenBothCamerasAreEqual) {
  ScannedScene scene;
  scene.K_color = scene.K_depth;
  scene.T_color_depth.setIdentity();
  const cv::Mat depth = *scene.depth(0);
  cv::Mat expected;
  depth.convertTo(expected, CV_32F, 0.001);
  EXPECT_EQ(cv::norm(registerDepth(firstFrame(scene), depth), expected, cv::NORM_INF), 0);
}

// Registered depth must equal the exact depth of the colour camera, except at edges (a pixel of depth is two
// of colour) and on surfaces that only one camera sees.
TEST(RegisterDepth, ReturnsDepthOfTheColorCamera) {
  ScannedScene scene;
  scene.depth_noise_px = 0;
  const KeyFrameInfo frame = firstFrame(scene);
  const cv::Mat registered = registerDepth(frame, *scene.depth(0));
  const cv::Mat exact = Shapes().renderView(frame.K_color, frame.colorCameraPose()).depth_m;
  ASSERT_EQ(registered.size(), exact.size());
  int both = 0, right = 0, gaps = 0;
  for (int v = 20; v < registered.rows - 20; ++v) {
    for (int u = 40; u < registered.cols - 40; ++u) {
      const float z = registered.at<float>(v, u), truth = exact.at<float>(v, u);
      if (!(truth > 0)) continue;
      ++both;
      if (z == 0) ++gaps;
      if (std::abs(z - truth) < 0.003F) ++right;  // rounding to millimetres, and facets of the ball
    }
  }
  EXPECT_GT(both, 100000);
  EXPECT_GT(right, 0.97 * both);
  EXPECT_LT(gaps, 0.02 * both) << "only shadows of the box";
}

TEST(RegisterDepth, OmitsSurfaces_HiddenFromTheColorCamera) {
  // A plate of 10 cm before a wall; the colour camera is 25 cm to the right of the depth camera.
  KeyFrameInfo frame;
  frame.K_depth = {100, 100, 49.5F, 49.5F, 100, 100};
  frame.K_color = frame.K_depth;
  frame.T_color_depth = Eigen::Translation3d(-0.25, 0, 0);
  cv::Mat depth(100, 100, CV_16UC1, cv::Scalar(2000));
  depth(cv::Rect(45, 45, 10, 10)) = 1000;
  const cv::Mat registered = registerDepth(frame, depth);
  // 100 * 0.25 / 1 = 25 pixels to the left for the plate, 12.5 for the wall.
  EXPECT_NEAR(registered.at<float>(50, 50 - 25), 1, 1e-5);
  EXPECT_NEAR(registered.at<float>(50, 60), 2, 1e-5);
  EXPECT_EQ(registered.at<float>(50, 38), 0) << "the plate hid this part of the wall from the depth camera";
  EXPECT_EQ(registered.at<float>(50, 95), 0) << "outside the depth image";
}

TEST(DepthRaster, KeepsTheNearestTriangle) {
  const Intrinsics K{100, 100, 20, 20, 41, 41};
  DepthRaster raster(K);
  raster.add({-1, -1, 3}, {1, -1, 3}, {0, 1, 3});
  const Eigen::Vector3f a(-0.4F, -0.2F, 2), b(0.4F, -0.2F, 2), c(0, 0.3F, 2.5F);
  raster.add(c, b, a);  // the back face counts as well
  const Eigen::Vector3f n = (b - a).cross(c - a);
  const auto on_plane = [&](float u, float v) { return a.dot(n) / K.backProject(u, v, 1).dot(n); };
  EXPECT_NEAR(raster.depth().at<float>(20, 20), on_plane(20, 20), 1e-5);
  EXPECT_NEAR(raster.depth().at<float>(13, 25), on_plane(25, 13), 1e-5);
  EXPECT_NEAR(raster.depth().at<float>(5, 20), 3, 1e-5);
  EXPECT_EQ(raster.depth().at<float>(40, 0), 0);
  raster.add({-1, -1, 0.005F}, {1, -1, 1}, {0, 1, 1});
  EXPECT_NEAR(raster.depth().at<float>(5, 20), 3, 1e-5)
      << "a triangle that reaches behind the camera is ignored";
}

}  // namespace
}  // namespace scantrove::test
