#include "core/tracking/key_frames.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

RgbdFrame frameOf(std::uint64_t seed) {
  RgbdFrame frame;
  cv::Mat patches(6, 8, CV_8UC3);
  cv::RNG(seed).fill(patches, cv::RNG::UNIFORM, 0, 256);
  cv::resize(patches, frame.color, {640, 480}, 0, 0, cv::INTER_CUBIC);
  return frame;
}

TEST(KeyFrames, AreDue_AtANewPositionOrDirection) {
  KeyFrames key_frames;
  EXPECT_TRUE(key_frames.isDue(pose(0, 0, 0, 0, 0, 0)));
  EXPECT_EQ(key_frames.nearest(pose(0, 0, 0, 0, 0, 0)), nullptr);
  key_frames.add({pose(0, 0, 0, 0, 0, 0), {}, {}});
  EXPECT_FALSE(key_frames.isDue(pose(0, 5, 0, 0.05, 0, 0)));
  EXPECT_TRUE(key_frames.isDue(pose(0, 20, 0, 0, 0, 0)));
  EXPECT_TRUE(key_frames.isDue(pose(0, 0, 0, 0.3, 0, 0)));
  key_frames.add({pose(0, 20, 0, 0, 0, 0), {}, {}});
  ASSERT_NE(key_frames.nearest(pose(0, 14, 0, 0, 0, 0)), nullptr);
  EXPECT_TRUE(key_frames.nearest(pose(0, 14, 0, 0, 0, 0))->T_world_camera.isApprox(pose(0, 20, 0, 0, 0, 0)));
  EXPECT_EQ(key_frames.nearest(pose(0, 180, 0, 0, 0, 0)), nullptr) << "it faces the other way";
}

TEST(KeyFrames, AlikeReturnsTheSameViewFirst) {
  KeyFrames key_frames;
  for (int i = 0; i < 30; ++i)
    key_frames.add({pose(0, 20.0 * i, 0, 0, 0, 0), {}, thumbnailOf(frameOf(static_cast<std::uint64_t>(i)))});
  RgbdFrame again = frameOf(17);
  again.color.convertTo(again.color, -1, 0.7, 20);  // another exposure
  cv::GaussianBlur(again.color, again.color, {9, 9}, 3);
  const auto found = key_frames.alike(thumbnailOf(again), ColorView{}, 3);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_TRUE(found[0]->T_world_camera.isApprox(pose(0, 20.0 * 17, 0, 0, 0, 0)));
  EXPECT_TRUE(key_frames.alike({}, ColorView{}, 3).empty());
}

TEST(ThumbnailOf, UsesDepth_WithoutColor) {
  RgbdFrame frame;
  frame.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000));
  frame.depth.colRange(0, 200) = 800;
  RgbdFrame mirrored;
  cv::flip(frame.depth, mirrored.depth, 1);  // a different view
  EXPECT_GT(thumbnailOf(frame).dot(thumbnailOf(frame)), 0.99);
  EXPECT_LT(thumbnailOf(frame).dot(thumbnailOf(mirrored)), 0.2);
  frame.depth = cv::Mat::zeros(480, 640, CV_16UC1);
  EXPECT_TRUE(thumbnailOf(frame).empty());
}

}  // namespace
}  // namespace scantrove::test
