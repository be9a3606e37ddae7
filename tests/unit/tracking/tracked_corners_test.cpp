#include "core/tracking/tracked_corners.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

const Intrinsics kWallCamera{525, 525, 319.5, 239.5, 640, 480};
constexpr double kWall_m = 1.5;

/// The view of a wall z = 1.5 m whose pattern has `contrast` grey levels.
GrayView wallFrom(const Eigen::Isometry3d& T_world_color, double contrast) {
  cv::Mat pattern(120, 160, CV_32FC1);
  cv::RNG(11).fill(pattern, cv::RNG::NORMAL, 0, 1);
  cv::resize(pattern, pattern, {1600, 1200}, 0, 0, cv::INTER_CUBIC);  // 2 mm a pixel, spots of 2 cm
  GrayView view;
  view.K = kWallCamera;
  cv::Mat map(480, 640, CV_32FC2);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector3d ray =
          T_world_color.linear() *
          kWallCamera.backProject(static_cast<float>(u), static_cast<float>(v), 1).cast<double>();
      const Eigen::Vector3d p =
          T_world_color.translation() + (kWall_m - T_world_color.translation().z()) / ray.z() * ray;
      map.at<cv::Vec2f>(v, u) = {static_cast<float>(800 + p.x() / 0.002),
                                 static_cast<float>(600 + p.y() / 0.002)};
    }
  }
  cv::Mat seen;
  cv::remap(pattern, seen, map, {}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
  cv::Mat noise(seen.size(), CV_32FC1);
  cv::RNG(static_cast<std::uint64_t>(1e6 * (T_world_color.translation().x() + 7)))
      .fill(noise, cv::RNG::NORMAL, 0, 1.8);
  cv::Mat gray = 128 + contrast * seen + noise;
  gray.convertTo(view.image, CV_8U);
  return view;
}

std::vector<cl_float4> wallSurface(const Eigen::Isometry3d& T_world_color) {
  std::vector<cl_float4> vertices;
  for (int v = 0; v < 480; v += 2) {
    for (int u = 0; u < 640; u += 2) {
      const Eigen::Vector3d ray =
          T_world_color.linear() *
          kWallCamera.backProject(static_cast<float>(u), static_cast<float>(v), 1).cast<double>();
      const Eigen::Vector3d p =
          T_world_color.translation() + (kWall_m - T_world_color.translation().z()) / ray.z() * ray;
      vertices.push_back(
          {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1}});
    }
  }
  return vertices;
}

/// The faint pattern (8 grey levels of contrast, 1.8 of noise) has few FAST corners.
TEST(FollowCorners, IsAccurateToAFractionOfAPixel_AtLowAndHighContrast) {
  for (const double contrast : {8, 45}) {
    SCOPED_TRACE(contrast);
    const Eigen::Isometry3d before = pose(0, 0, 0, 0, 0, 0);
    const Eigen::Isometry3d after = pose(0.5, -1, 1, 0.02, 0.01, -0.01);
    const GrayView last = wallFrom(before, contrast);
    const SurfaceInView surface(kWallCamera, before, wallSurface(before));
    const SeenLandmarks seen = trackCorners(last, surface, wallFrom(after, contrast), before);
    EXPECT_GT(seen.pixels.size(), 100U);
    EXPECT_GT(seen.cells(), 35);
    EXPECT_LT(seen.errorPx(after), 0.3);
    EXPECT_GT(seen.errorPx(before), 4);
  }
}

TEST(FollowCorners, FindsFewOrNone_WhenTheImageDiffers) {
  const Eigen::Isometry3d here = pose(0, 0, 0, 0, 0, 0);
  const SurfaceInView surface(kWallCamera, here, wallSurface(here));
  const GrayView last = wallFrom(here, 8);
  const SeenLandmarks elsewhere = trackCorners(last, surface, wallFrom(pose(0, 0, 0, 1.2, 0, 0), 8), here);
  EXPECT_LT(elsewhere.pixels.size(), 30U);
  GrayView dark = last;
  dark.image = cv::Mat::zeros(480, 640, CV_8UC1);
  EXPECT_TRUE(trackCorners(last, surface, dark, here).pixels.empty());
  EXPECT_TRUE(trackCorners(GrayView{}, surface, last, here).pixels.empty());
}

}  // namespace
}  // namespace scantrove::test
