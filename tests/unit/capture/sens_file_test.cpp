// .sens files of a few small frames, written after the documented layout.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/captured_log.h"
#include "tests/support/sens_bytes.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using Status = FrameRead::Status;

std::string encoded(const std::string& extension, const cv::Mat& image) {
  std::vector<uchar> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string sensDepthBytes(int value) {
  const cv::Mat depth = tinyDepth(value);
  return {reinterpret_cast<const char*>(depth.data), depth.total() * depth.elemSize()};
}

SensFileBytes threeFrames() {
  SensFileBytes sens;
  for (int i = 0; i < 3; ++i) {
    SensFrameBytes frame;
    frame.pose[3] = 0.25F * static_cast<float>(i);
    frame.time = static_cast<std::uint64_t>(1'000'000 + 33'333 * i);  // microseconds
    frame.color = encoded(".jpg", tinyColor(100 + i, {128, 96}));
    frame.depth = zlibStored(sensDepthBytes(1500 + i));
    sens.frames.push_back(frame);
  }
  sens.frames[1].pose.fill(-std::numeric_limits<float>::infinity());
  return sens;
}

TEST(SensFile, ReadsCamerasImagesTimesAndPoses) {
  const TemporaryFolder folder;
  SensFileBytes sens = threeFrames();
  sens.T_rig_color[3] = 0.02F;
  const auto source = openSource(folder.write("scene0000_00.sens", sens.bytes()).string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, ".sens file");
  EXPECT_EQ(info.frame_count, 3);
  EXPECT_TRUE(info.has_poses);
  EXPECT_EQ(info.pose_origin, PoseOrigin::truth);
  EXPECT_EQ(info.intrinsics, (Intrinsics{60, 60, 31.5F, 23.5F, 64, 48}));
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const FrameRead& read = reads[static_cast<std::size_t>(i)];
    ASSERT_EQ(read.status, Status::frame) << read.error.message();
    EXPECT_EQ(read.frame.index, i);
    EXPECT_NEAR(read.frame.timestamp_s, 1 + 0.033333 * i, 1e-9);
    EXPECT_EQ(read.frame.depth.at<std::uint16_t>(20, 30), 1500 + i);
    EXPECT_FLOAT_EQ(read.frame.meters_per_unit, 0.001F);
    EXPECT_NEAR(read.frame.color.at<cv::Vec3b>(20, 30)[0], 100 + i, 3);
    ASSERT_TRUE(read.frame.color_camera);
    EXPECT_EQ(read.frame.color_camera->K, (Intrinsics{120, 120, 63.5F, 47.5F, 128, 96}));
    EXPECT_NEAR(read.frame.color_camera->T_color_depth.translation().x(), -0.02, 1e-6);
  }
  ASSERT_TRUE(reads[2].frame.T_world_camera);
  EXPECT_DOUBLE_EQ(reads[2].frame.T_world_camera->translation().x(), 0.5);
  EXPECT_FALSE(reads[1].frame.T_world_camera) << "-inf: no pose";
}

TEST(SensFile, TakesEqualCamerasAsRegistered_AndRawImages) {
  const TemporaryFolder folder;
  SensFileBytes sens = threeFrames();
  sens.color_camera = sens.depth_camera;
  sens.color_width = 64;
  sens.color_height = 48;
  sens.color_coding = sens.depth_coding = 0;
  for (SensFrameBytes& frame : sens.frames) {
    std::string rgb;
    for (int i = 0; i < 64 * 48; ++i) rgb += "\x01\x02\x03";
    frame.color = rgb;
    frame.depth = sensDepthBytes(2000);
    frame.time = 0;
  }
  const auto source = openSource(folder.write("raw.sens", sens.bytes()).string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[0].frame.color.at<cv::Vec3b>(1, 1), cv::Vec3b(3, 2, 1));
  EXPECT_EQ(reads[0].frame.depth.at<std::uint16_t>(1, 1), 2000);
  EXPECT_FALSE(reads[0].frame.color_camera);
  EXPECT_DOUBLE_EQ(reads[2].frame.timestamp_s, 2 / 30.0) << "times that do not increase are none";
}

TEST(SensFile, IsOpened_WhenItIsTheOnlyOneInAFolder) {
  const TemporaryFolder folder;
  folder.write("scene/scene.sens", threeFrames().bytes());
  folder.write("scene/scene.txt", "numDepthFrames = 3\n");
  const auto source = openSource((folder / "scene").string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().frame_count, 3);
}

TEST(SensFile, GivesCompleteFrames_WhenTruncated) {
  const TemporaryFolder folder;
  const std::string bytes = threeFrames().bytes();
  const CapturedLog log;
  const auto source = openSource(folder.write("cut.sens", bytes.substr(0, bytes.size() - 10)).string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().frame_count, 2);
  EXPECT_THAT(log.text(), HasSubstr("2 of 3 frames"));
}

TEST(SensFile, SkipsAFrame_WhenItsImageIsDamaged) {
  const TemporaryFolder folder;
  SensFileBytes sens = threeFrames();
  sens.frames[1].depth[20] = '\x55';  // fails the checksum
  sens.frames[2].color.resize(40);
  const auto source = openSource(folder.write("bad.sens", sens.bytes()).string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[0].status, Status::frame);
  EXPECT_EQ(reads[1].status, Status::skipped);
  EXPECT_THAT(reads[1].error.what, HasSubstr("image 1 of"));
  EXPECT_EQ(reads[2].status, Status::skipped);
}

TEST(SensFile, NamesTheFile_WhenItCannotBeRead) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& bytes) { return openError(folder.write("x.sens", bytes)); };
  EXPECT_THAT(error("no recording"), HasSubstr("x.sens is no .sens file of version 4"));
  EXPECT_THAT(error(threeFrames().bytes().substr(0, 200)), HasSubstr("header is incomplete"));
  SensFileBytes sens = threeFrames();
  sens.depth_coding = 2;
  EXPECT_THAT(error(sens.bytes()), HasSubstr("OCCI"));
  sens = threeFrames();
  sens.depth_width = 1'000'000;
  EXPECT_THAT(error(sens.bytes()), HasSubstr("1000000x48"));
  sens = threeFrames();
  sens.frames.clear();
  EXPECT_THAT(error(sens.bytes()), HasSubstr("no complete frame"));
}

}  // namespace
}  // namespace scantrove
