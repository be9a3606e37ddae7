// OpenNI2 without hardware: Debian's virtual camera, and a genuine recording if available.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/capture/cameras.h"
#include "core/capture/color_registration.h"
#include "core/capture/depth_plausibility.h"
#include "tests/support/recordings.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using Status = FrameRead::Status;

TEST(VirtualCamera, ReturnsLiveFrames) {
  const auto source = openSource("camera:Dummy", {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "OpenNI2 camera");
  EXPECT_TRUE(info.is_live);
  EXPECT_FALSE(info.frame_count);
  EXPECT_GT(info.intrinsics.fx, 0);
  int last_index = -1;
  for (int frames = 0, waits = 0; frames < 5 && waits < 10;) {
    const FrameRead read = (*source)->next();
    if (read.status == Status::timeout) {
      ++waits;
      continue;
    }
    ASSERT_EQ(read.status, Status::frame) << read.error.message();
    EXPECT_GT(read.frame.index, last_index);
    EXPECT_EQ(read.frame.index, last_index + 1 + read.dropped);
    EXPECT_EQ(read.frame.depth.type(), CV_16UC1);
    EXPECT_EQ(read.frame.color.type(), CV_8UC3);
    EXPECT_EQ(read.frame.depth.size(), cv::Size(info.intrinsics.width, info.intrinsics.height));
    EXPECT_EQ(read.frame.color.size(), read.frame.depth.size());
    last_index = read.frame.index;
    ++frames;
  }
  EXPECT_GE(last_index, 4);
}

TEST(VirtualCamera, UsesAColorCamera_WhenOptionsGiveOne) {
  SourceOptions options;
  options.color_registration = ColorRegistration{kinectColorCamera()};
  const auto source = openSource("camera:Dummy", options);
  ASSERT_TRUE(source) << source.error().message();
  FrameRead read = (*source)->next();
  for (int waits = 0; read.status == Status::timeout && waits < 10; ++waits) read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  ASSERT_TRUE(read.frame.color_camera);
  EXPECT_EQ(read.frame.color_camera->K.width, read.frame.color.cols);
  EXPECT_FLOAT_EQ(read.frame.color_camera->K.fx, 528.0F * static_cast<float>(read.frame.color.cols) / 640.0F);
  options.color_registration = ColorRegistration{ColorCamera{{500, 500, 4000, 240, 0, 0}}};
  const auto refused = openSource("camera:Dummy", options);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("--color-registration"));
}

TEST(VirtualCamera, EndsAfterTheRequestedFrames_WhenSomeAreDropped) {
  SourceOptions options;
  options.frames = 2;
  const auto source = openSource("camera:Dummy", options);
  ASSERT_TRUE(source) << source.error().message();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the time of 15 frames
  const auto reads = readAll(**source);
  const auto is_frame = [](const FrameRead& read) { return read.status == Status::frame; };
  EXPECT_EQ(std::count_if(reads.begin(), reads.end(), is_frame), 2) << reads.back().error.message();
  const auto first = std::find_if(reads.begin(), reads.end(), is_frame);
  ASSERT_NE(first, reads.end());
  EXPECT_GT(first->dropped, 0);
}

TEST(VirtualCamera, Reopens_WhenItWasClosed) {
  for (int i = 0; i < 3; ++i) {
    const auto source = openSource("camera:Dummy", {});
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_NE((*source)->next().status, Status::failed);
  }
}

TEST(Cameras, OmitTheVirtualCamera_WhenListed) {
  ASSERT_TRUE(openSource("camera:Dummy", {}));
  const auto cameras = listCameras();
  ASSERT_TRUE(cameras) << cameras.error().message();
  for (const CameraInfo& camera : *cameras) {
    EXPECT_NE(camera.uri, "Dummy");
  }
  if (cameras->empty()) {
    EXPECT_THAT(openError("camera"), AllOf(HasSubstr("No depth camera"), HasSubstr("udev"),
                                           HasSubstr("045e:02ae"), HasSubstr("camera:Dummy")));
  }
}

TEST(Cameras, NameTheUriWithAdvice_WhenItIsUnknown) {
  EXPECT_THAT(openError("camera:1d27/0601@9/99"), AllOf(HasSubstr("1d27/0601@9/99"), HasSubstr("udev")));
}

TEST(OniRecording, ReadsToItsEnd) {
  SCANTROVE_NEED_RECORDING(path, "oni/kinect-12-frames.oni");
  const auto source = openSource(path.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "OpenNI2 recording");
  EXPECT_FALSE(info.is_live);
  EXPECT_EQ(info.frame_count, 12);
  EXPECT_NEAR(info.intrinsics.fx, 575, 60);  // a Kinect
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 12U);
  double last_time = -1;
  for (std::size_t i = 0; i < reads.size(); ++i) {
    ASSERT_EQ(reads[i].status, Status::frame) << reads[i].error.message();
    const RgbdFrame& frame = reads[i].frame;
    EXPECT_EQ(frame.index, static_cast<int>(i));
    EXPECT_GT(frame.timestamp_s, last_time);
    EXPECT_EQ(frame.depth.size(), cv::Size(640, 480));
    EXPECT_EQ(frame.color.size(), cv::Size(640, 480));
    const auto median = medianDepth(frame.depth, frame.meters_per_unit);
    EXPECT_TRUE(median && *median > 0.3 && *median < 8);
    last_time = frame.timestamp_s;
  }
}

TEST(OniRecording, SelectsFrames) {
  SCANTROVE_NEED_RECORDING(path, "oni/kinect-12-frames.oni");
  SourceOptions options;
  options.start = 3;
  options.stride = 4;
  const auto source = openSource(path.string(), options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().frame_count, 3);
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[0].frame.index, 3);
  EXPECT_EQ(reads[2].frame.index, 11);
  options.start = 12;
  EXPECT_THAT(openError(path, options), HasSubstr("has 12 frames"));
}

TEST(OniRecording, ReturnsTheSameFrames_WhenReadTwice) {
  SCANTROVE_NEED_RECORDING(path, "oni/kinect-12-frames.oni");
  std::vector<double> sums[2];
  for (auto& sum : sums) {
    const auto source = openSource(path.string(), {});
    ASSERT_TRUE(source);
    for (const FrameRead& read : readAll(**source)) {
      sum.push_back(cv::sum(read.frame.depth)[0] + 1e-3 * cv::sum(read.frame.color)[0]);
    }
  }
  EXPECT_EQ(sums[0], sums[1]);
}

}  // namespace
}  // namespace scantrove
