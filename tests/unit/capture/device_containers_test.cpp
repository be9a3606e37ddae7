// Recordings that real devices made.
#include "core/capture/containers/kinect_recording.h"
#include "core/capture/depth_plausibility.h"
#include "tests/support/recordings.h"
#include "tests/unit/capture/container_fixture.h"

namespace scantrove {
namespace {

using namespace test;

double holesIn(const cv::Mat& depth) {
  return 1 - static_cast<double>(cv::countNonZero(depth)) / static_cast<double>(depth.total());
}

TEST(DeviceContainers, ReadsARealsenseBag) {
  SCANTROVE_NEED_RECORDING(file, "devices/containers/realsense.bag");
  const auto source = openInput(file.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().kind, "RealSense recording");
  EXPECT_FALSE((*source)->info().implausible_depth);
  EXPECT_NEAR((*source)->info().intrinsics.fx, 390.43F, 0.01F);
  EXPECT_NEAR((*source)->info().intrinsics.cx, 331.39F, 0.01F);
  const auto frames = readAllFrames(file);
  ASSERT_EQ(frames.size(), 2U);
  for (const RgbdFrame& frame : frames) {
    EXPECT_EQ(frame.depth.size(), cv::Size(640, 480));
    EXPECT_NEAR(frame.meters_per_unit, 0.001F, 1e-8F);
    EXPECT_NEAR(*medianDepth(frame.depth, static_cast<double>(frame.meters_per_unit)), 1.475, 0.006);
    EXPECT_NEAR(holesIn(frame.depth), 0.067, 0.001);
  }
  // The only colour image belongs to the first.
  ASSERT_EQ(frames[0].color.size(), cv::Size(640, 480));
  EXPECT_TRUE(frames[1].color.empty());
  ASSERT_TRUE(frames[0].color_camera);
  EXPECT_NEAR(frames[0].color_camera->K.fx, 613.20F, 0.01F);
  EXPECT_NEAR(frames[0].color_camera->T_color_depth.translation().norm(), 0.0143, 0.0001);
  EXPECT_GT(frames[0].color_camera->T_color_depth.translation().x(), 0.014);
}

TEST(DeviceContainers, ReadsAnAzureKinectRecording) {
  SCANTROVE_NEED_RECORDING(file, "devices/containers/azure-kinect.mkv");
  const auto source = openInput(file.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_FALSE((*source)->info().implausible_depth);
  const Intrinsics& K = (*source)->info().intrinsics;
  EXPECT_NEAR(K.fx, 504.6F, 0.1F);
  EXPECT_NEAR(K.cx, 332.8F, 0.1F);
  EXPECT_NEAR(K.cy, 348.8F, 0.1F);
  const auto frames = readAllFrames(file);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].depth.size(), cv::Size(640, 576));
  // The corners that the camera leaves out are not in view of the undistorted image.
  EXPECT_NEAR(*medianDepth(frames[0].depth, 0.001), 1.48, 0.01);
  EXPECT_NEAR(holesIn(frames[0].depth), 0.124, 0.005);
  ASSERT_EQ(frames[0].color.size(), cv::Size(1280, 720));
  ASSERT_TRUE(frames[0].color_camera);
  EXPECT_NEAR(frames[0].color_camera->T_color_depth.translation().norm(), 0.0324, 0.0002);
}

TEST(DeviceContainers, GivesTheDepthThatAnAzureKinectRecorded) {
  SCANTROVE_NEED_RECORDING(path, "devices/containers/azure-kinect.mkv");
  OpeningProgress progress("azure-kinect.mkv", {});
  auto file = MatroskaFile::open(path, progress);
  ASSERT_TRUE(file) << file.error().message();
  const auto images = openKinectRecording(std::move(*file));
  ASSERT_TRUE(images) << images.error().message();
  ASSERT_EQ((*images)->count(), 1U);
  const auto frame = (*images)->read(0);
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_NEAR(*medianDepth(frame->depth, 0.001), 1.491, 0.001);
  EXPECT_NEAR(holesIn(frame->depth), 0.2352, 0.0001);
}

}  // namespace
}  // namespace scantrove
