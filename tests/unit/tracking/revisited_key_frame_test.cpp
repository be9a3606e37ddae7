// A camera that comes back to a place while the map has drifted.
#include "core/tracking/revisited_key_frame.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

const Intrinsics kPictureCamera{525, 525, 319.5, 239.5, 640, 480};
constexpr float kPicture_m = 2;
const cv::Mat kThumbnail = cv::Mat::ones(30, 40, CV_32FC1) / std::sqrt(1200.0);

/// A picture on a wall two metres before a camera at the origin, with `count` features of a look of their
/// own.
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

/// The wall as a map has it that has drifted by `drift_m` along x (which is to the camera's right).
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

/// What that camera, which has the same picture before it and is thought to be `drift_m` to the right, is
/// told.
std::optional<RevisitedKeyFrame> askAt(const KeyFrames& places, const ColorView& view, double drift_m) {
  const Eigen::Isometry3d T_world_color(Eigen::Translation3d(drift_m, 0, 0));
  const std::vector<cl_float4> vertices = wall(drift_m);
  return returnedTo(places, kThumbnail, view, SurfaceInView(kPictureCamera, T_world_color, vertices));
}

/// The place of `view`, and then so many others, on a way of about a metre each.
KeyFrames keyFramesWith(const ColorView& view, int others) {
  KeyFrames places;
  const std::vector<cl_float4> vertices = wall(0);
  places.add({Eigen::Isometry3d::Identity(), landmarksOf(view, Eigen::Isometry3d::Identity(), vertices),
              kThumbnail});
  for (int i = 0; i < others; ++i) {
    const auto T = pose(0, 30.0 * i, 0, i % 2, 0, 0);
    places.add(
        {T, landmarksOf(pictureOf(100 + static_cast<std::uint64_t>(i), 200), T, vertices), kThumbnail});
  }
  return places;
}

TEST(RevisitedKeyFrame, SaysHowFarTheMapHasDrifted) {
  const ColorView view = pictureOf(1, 200);
  const KeyFrames places = keyFramesWith(view, 12);
  for (const double drift_m : {0.0, 0.05, 0.4}) {
    const auto returned = askAt(places, view, drift_m);
    ASSERT_TRUE(returned) << drift_m;
    EXPECT_NEAR(returned->drift_m, drift_m, 0.01);
    EXPECT_GT(returned->landmarks, 150);
  }
}

TEST(RevisitedKeyFrame, WhatLooksTheSameFartherOffThanAnyMapDriftsIsAnotherPlace) {
  const ColorView view = pictureOf(1, 200);
  const KeyFrames places = keyFramesWith(view, 12);
  const double way = places.distanceSince(places.all().front());
  EXPECT_NEAR(way, 11 * (1 + 30 * 3.14159 / 180), 0.1);
  EXPECT_TRUE(askAt(places, view, 0.09 * way));
  EXPECT_FALSE(askAt(places, view, 0.12 * way));
  EXPECT_FALSE(askAt(places, view, 9));
}

TEST(RevisitedKeyFrame, WhereTheCameraJustWasItHasNotReturnedTo) {
  const ColorView view = pictureOf(1, 200);
  EXPECT_FALSE(askAt(keyFramesWith(view, 7), view, 0.4));
  EXPECT_TRUE(askAt(keyFramesWith(view, 8), view, 0.4));
}

TEST(RevisitedKeyFrame, OfAnotherPictureOrAFewFeaturesNothingIsSaid) {
  EXPECT_FALSE(askAt(keyFramesWith(pictureOf(1, 200), 12), pictureOf(2, 200), 0.1));
  const ColorView poor = pictureOf(3, 45);
  EXPECT_FALSE(askAt(keyFramesWith(poor, 12), poor, 0.1));
}

}  // namespace
}  // namespace scantrove::test
