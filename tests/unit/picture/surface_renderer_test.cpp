#include "core/picture/surface_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "tests/unit/picture/cube_scan.h"

namespace scantrove::test {
namespace {

constexpr int kSide_px = 41;

/// 5 m before the middle of the cube, along z, with the axes of the world. The near side of the cube is 4 m
/// away: its corners lie 40 * 1 / 4 = 10 pixels from the centre, (20, 20).
PictureCamera cameraBeforeCube() {
  PictureCamera camera{.focal_px = 40, .width = kSide_px, .height = kSide_px};
  camera.T_camera_world.translation() = Eigen::Vector3f(0, 0, 5);
  return camera;
}

bool isCovered(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x) != kPictureBackground; }

/// A square that faces the camera, of `half_m` around the optical axis, at world `z`.
void addSquare(PictureSurface& surface, float half_m, float z, const Rgb& color) {
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  for (const auto& [x, y] : std::array<std::pair<int, int>, 4>{{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}) {
    surface.vertices.push_back(
        {{half_m * static_cast<float>(x), half_m * static_cast<float>(y), z}, {0, 0, -1}, color});
  }
  surface.faces.push_back({first, first + 1, first + 2});
  surface.faces.push_back({first, first + 2, first + 3});
}

TEST(SurfaceRenderer, CoversThePixelsOfTheNearSide) {
  const cv::Mat image = renderSurface(cubeSurface({200, 100, 50}), cameraBeforeCube());
  ASSERT_EQ(image.type(), CV_8UC3);
  ASSERT_EQ(image.size(), cv::Size(kSide_px, kSide_px));
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const bool inside = x >= 10 && x <= 30 && y >= 10 && y <= 30;
      EXPECT_EQ(isCovered(image, x, y), inside) << x << " " << y;
    }
  }
}

TEST(SurfaceRenderer, ShadesByTheAngleToTheCamera) {
  const cv::Mat image = renderSurface(cubeSurface({200, 100, 50}), cameraBeforeCube());
  EXPECT_EQ(image.at<cv::Vec3b>(20, 20), cv::Vec3b(50, 100, 200));  // seen straight on
  // The ray to pixel (30, 30) is (1, 1, 4): its cosine to the normal is 4 / sqrt(18).
  const double light = double{kAmbientLight} + (1 - double{kAmbientLight}) * 4 / std::sqrt(18.0);
  EXPECT_NEAR(image.at<cv::Vec3b>(30, 30)[2], 200 * light, 1);
}

TEST(SurfaceRenderer, ShowsTheNearest_WhateverTheOrder) {
  const Rgb red{255, 0, 0}, blue{0, 0, 255};
  for (const bool near_first : {true, false}) {
    PictureSurface surface;
    addSquare(surface, near_first ? 0.5F : 1.0F, near_first ? -1.0F : 1.0F, near_first ? red : blue);
    addSquare(surface, near_first ? 1.0F : 0.5F, near_first ? 1.0F : -1.0F, near_first ? blue : red);
    const cv::Mat image = renderSurface(surface, cameraBeforeCube());
    EXPECT_EQ(image.at<cv::Vec3b>(20, 20), cv::Vec3b(0, 0, 255));  // red, BGR
    // Red reaches 40 * 0.5 / 4 = 5 pixels, blue 40 / 6 = 6.67.
    EXPECT_GT(image.at<cv::Vec3b>(20, 25)[2], 200);
    EXPECT_GT(image.at<cv::Vec3b>(20, 26)[0], 200);
    EXPECT_FALSE(isCovered(image, 27, 20));
  }
}

TEST(SurfaceRenderer, OmitsFacesSeenFromInside) {
  PictureSurface surface;
  addSquare(surface, 1, 0, {255, 255, 255});
  for (auto& face : surface.faces) std::swap(face[1], face[2]);
  const cv::Mat image = renderSurface(surface, cameraBeforeCube());
  EXPECT_FALSE(isCovered(image, 20, 20));
}

TEST(SurfaceRenderer, InterpolatesColorsInSpace_NotInThePicture) {
  // A face that recedes from 4 m (black, at x = -10) to 8 m (white, at x = +10 pixels): halfway between them
  // in the picture, (1/4 + 1/8) / 2 = 3/16 per metre is 16/3 m; the white corner's weight is (16/3 - 4) / (8
  // - 4) = 1/3.
  PictureSurface surface;
  for (const float y : {-2.0F, 2.0F}) {
    surface.vertices.push_back({{-1, y, -1}, {0, 0, -1}, {0, 0, 0}});
    surface.vertices.push_back({{2, y, 3}, {0, 0, -1}, {255, 255, 255}});
  }
  surface.faces = {{0, 2, 3}, {0, 3, 1}};
  for (auto& vertex : surface.vertices) vertex.normal_world = Eigen::Vector3f(0, 0, -1);
  const cv::Mat image = renderSurface(surface, cameraBeforeCube());
  EXPECT_NEAR(image.at<cv::Vec3b>(20, 20)[0], 85, 1);  // on the axis, so that the light is full
}

TEST(SurfaceRenderer, FaceColorsReplaceThoseOfVertices) {
  PictureSurface surface = cubeSurface({255, 255, 255});
  surface.face_colors.assign(surface.faces.size(), Rgb{0, 0, 0});
  EXPECT_EQ(renderSurface(surface, cameraBeforeCube()).at<cv::Vec3b>(20, 20), cv::Vec3b(0, 0, 0));
}

TEST(SurfaceRenderer, OmitsFacesBehindTheCamera) {
  PictureCamera camera = cameraBeforeCube();
  camera.T_camera_world.translation() = Eigen::Vector3f(0, 0, -5);
  const cv::Mat image = renderSurface(cubeSurface({255, 255, 255}), camera);
  EXPECT_FALSE(isCovered(image, 20, 20));
}

}  // namespace
}  // namespace scantrove::test
