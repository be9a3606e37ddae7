// A camera returns to a key frame after the map has drifted.
#include "core/tracking/revisited_key_frame.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

const Intrinsics kPictureCamera{525, 525, 319.5, 239.5, 640, 480};
constexpr float kPicture_m = 2;
const cv::Mat kThumbnail = cv::Mat::ones(30, 40, CV_32FC1) / std::sqrt(1200.0);

/// The view of a picture on a wall, 2 m in front of a camera at the origin, with `count` random features.
ColorView pictureOf(std::uint64_t seed, int count) {
  cv::RNG random(seed);
  ColorView view;
  view.K = kPictureCamera;
  for (int i = 0; i < count; ++i)
    view.pixels.emplace_back(random.uniform(40.0F, 600.0F), random.uniform(40.0F, 440.0F));
  view.descriptors.create(count, 32, CV_8UC1);
  random.fill(view.descriptors, cv::RNG::UNIFORM, 0, 256);
  return view;
}

/// The wall in a map that has drifted by `drift_m` along x, to the right of the camera.
std::vector<cl_float4> wall(double drift_m) {
  std::vector<cl_float4> vertices;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const Eigen::Vector3f p = kPictureCamera.resizedTo(320, 240).backProject(
          static_cast<float>(u), static_cast<float>(v), kPicture_m);
      vertices.push_back({{p.x() + static_cast<float>(drift_m), p.y(), p.z(), 1}});
    }
  }
  return vertices;
}

/// The key frame found by a camera at the origin whose estimated position has drifted by `drift_m`.
std::optional<RevisitedKeyFrame> findAt(const KeyFrames& key_frames, const ColorView& view, double drift_m) {
  const Eigen::Isometry3d T_world_color(Eigen::Translation3d(drift_m, 0, 0));
  const std::vector<cl_float4> vertices = wall(drift_m);
  return returnedTo(key_frames, kThumbnail, view, SurfaceInView(kPictureCamera, T_world_color, vertices));
}

/// A key frame of `view` and then `others` more, about 1 m of camera path each.
KeyFrames keyFramesWith(const ColorView& view, int others) {
  KeyFrames key_frames;
  const std::vector<cl_float4> vertices = wall(0);
  key_frames.add({Eigen::Isometry3d::Identity(), landmarksOf(view, Eigen::Isometry3d::Identity(), vertices),
                  kThumbnail});
  for (int i = 0; i < others; ++i) {
    const auto T = pose(0, 30.0 * i, 0, i % 2, 0, 0);
    key_frames.add(
        {T, landmarksOf(pictureOf(100 + static_cast<std::uint64_t>(i), 200), T, vertices), kThumbnail});
  }
  return key_frames;
}

TEST(RevisitedKeyFrame, MeasuresTheDrift) {
  const ColorView view = pictureOf(1, 200);
  const KeyFrames key_frames = keyFramesWith(view, 12);
  for (const double drift_m : {0.0, 0.05, 0.4}) {
    const auto returned = findAt(key_frames, view, drift_m);
    ASSERT_TRUE(returned) << drift_m;
    EXPECT_NEAR(returned->drift_m, drift_m, 0.01);
    EXPECT_GT(returned->landmarks, 150);
  }
}

TEST(RevisitedKeyFrame, FindsNothing_WhenTheDriftIsImplausible) {
  const ColorView view = pictureOf(1, 200);
  const KeyFrames key_frames = keyFramesWith(view, 12);
  const double path_m = key_frames.distanceSince(key_frames.all().front());
  EXPECT_NEAR(path_m, 11 * (1 + 30 * 3.14159 / 180), 0.1);
  EXPECT_TRUE(findAt(key_frames, view, 0.09 * path_m));
  EXPECT_FALSE(findAt(key_frames, view, 0.12 * path_m));
  EXPECT_FALSE(findAt(key_frames, view, 9));
}

TEST(RevisitedKeyFrame, FindsNothing_WhenTheCameraHasJustLeft) {
  const ColorView view = pictureOf(1, 200);
  EXPECT_FALSE(findAt(keyFramesWith(view, 7), view, 0.4));
  EXPECT_TRUE(findAt(keyFramesWith(view, 8), view, 0.4));
}

TEST(RevisitedKeyFrame, FindsNothing_WithOtherOrFewFeatures) {
  EXPECT_FALSE(findAt(keyFramesWith(pictureOf(1, 200), 12), pictureOf(2, 200), 0.1));
  const ColorView poor = pictureOf(3, 45);
  EXPECT_FALSE(findAt(keyFramesWith(poor, 12), poor, 0.1));
}

}  // namespace
}  // namespace scantrove::test
