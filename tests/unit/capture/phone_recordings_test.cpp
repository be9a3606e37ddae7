// Real recordings of phones: K, unit and axes are right where neighbouring depth images agree.
#include <gtest/gtest.h>

#include "core/capture/open_input.h"
#include "tests/support/recordings.h"
#include "tests/support/warp_error.h"

namespace scantrove {
namespace {

using namespace test;

/// What a recording is expected to hold.
struct Expected {
  std::string kind;
  int frames = 0;
  int step = 1;  ///< between frames that are compared
  cv::Size color{1920, 1440};
  bool has_confidence = true;
  float focal_px = 0;  ///< of the first frame, for 256 x 192
};

std::vector<PosedFrame> readPosedFrames(FrameSource& source) {
  std::vector<PosedFrame> frames;
  for (FrameRead read = source.next(); read.status != FrameRead::Status::end; read = source.next()) {
    EXPECT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
    if (read.status != FrameRead::Status::frame) break;
    EXPECT_TRUE(read.frame.T_world_camera) << read.frame.index;
    PosedFrame& frame = frames.emplace_back();
    frame.K = read.frame.intrinsics.value_or(source.info().intrinsics);
    frame.T_world_camera = read.frame.T_world_camera.value_or(Eigen::Isometry3d::Identity());
    frame.frame = std::move(read.frame);
  }
  return frames;
}

double medianWarp(const std::vector<PosedFrame>& frames, std::size_t step, bool is_relative) {
  std::vector<double> errors;
  for (std::size_t i = 0; i + step < frames.size(); ++i) {
    if (const auto error = warpError(frames[i], frames[i + step]))
      errors.push_back(is_relative ? error->error_m / error->depth_m : error->error_m);
  }
  return errors.empty() ? 1e3 : medianOf(errors);
}

void expectConsistent(std::vector<PosedFrame> frames, int step) {
  const auto distance = static_cast<std::size_t>(step);
  EXPECT_LT(medianWarp(frames, distance, true), 0.01) << "share of the depth";
  const double right_m = medianWarp(frames, distance, false);
  for (PosedFrame& frame : frames) frame.T_world_camera = withFlippedAxes(frame.T_world_camera);
  EXPECT_GT(medianWarp(frames, distance, false), 2 * right_m) << "with the other axes";
}

void expectRecording(const std::filesystem::path& path, const Expected& expected) {
  const auto source = openInput(path.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, expected.kind);
  EXPECT_EQ(info.frame_count, expected.frames);
  EXPECT_TRUE(info.has_poses);
  EXPECT_EQ(info.pose_origin, PoseOrigin::device);
  const std::vector<PosedFrame> frames = readPosedFrames(**source);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(expected.frames));
  const RgbdFrame& first = frames.front().frame;
  EXPECT_EQ(first.depth.size(), cv::Size(256, 192));
  EXPECT_EQ(first.color.size(), expected.color);
  EXPECT_EQ(!first.confidence.empty(), expected.has_confidence);
  EXPECT_NEAR(frames.front().K.fx, expected.focal_px, 0.01);
  EXPECT_EQ(cv::Size(frames.front().K.width, frames.front().K.height), first.depth.size());
  expectConsistent(frames, expected.step);
}

// The chair's focal lengths: 1447.654 pixels at 1920 in its first frame (193.02 at 256).
constexpr float kChairFocal_px = 1447.654F * 256 / 1920;

TEST(PhoneRecordings, Reads3dScannerApp) {
  SCANTROVE_NEED_RECORDING(path, "devices/3dscannerapp");
  expectRecording(path,
                  {.kind = "3D Scanner App", .frames = 76, .step = 5, .focal_px = 1453.95F * 256 / 1920});
}

TEST(PhoneRecordings, GivesColorToEveryThirdFrame_Of3dScannerApp) {
  SCANTROVE_NEED_RECORDING(path, "devices/3dscannerapp");
  const auto source = openInput(path.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  int with_color = 0;
  for (const PosedFrame& frame : readPosedFrames(**source)) with_color += frame.frame.color.empty() ? 0 : 1;
  EXPECT_EQ(with_color, 26);
}

TEST(PhoneRecordings, ReadsFramesWithoutColor_WhenOptionsSelectThose) {
  SCANTROVE_NEED_RECORDING(path, "devices/3dscannerapp");
  SourceOptions options;
  options.start = 1;
  options.stride = 3;
  const auto source = openInput(path.string(), options);
  ASSERT_TRUE(source) << source.error().message();
  const auto frames = readPosedFrames(**source);
  ASSERT_EQ(frames.size(), 25U);
  EXPECT_TRUE(frames.front().frame.color.empty());
}

TEST(PhoneRecordings, ReadsStrayScanner) {
  SCANTROVE_NEED_RECORDING(path, "devices/stray");
  expectRecording(path, {.kind = "Stray Scanner", .frames = 16, .focal_px = kChairFocal_px});
}

TEST(PhoneRecordings, ReadsPolycam) {
  SCANTROVE_NEED_RECORDING(path, "devices/polycam");
  expectRecording(path, {.kind = "Polycam", .frames = 16, .focal_px = kChairFocal_px});
}

TEST(PhoneRecordings, ReadsRecord3dExport) {
  SCANTROVE_NEED_RECORDING(path, "devices/record3d-exr");
  // One K for all frames: 723.827 at 960.
  expectRecording(path, {.kind = "Record3D",
                         .frames = 16,
                         .color = {960, 720},
                         .has_confidence = false,
                         .focal_px = 723.8271F * 256 / 960});
}

TEST(PhoneRecordings, ReadsRecord3dArchive) {
  SCANTROVE_NEED_RECORDING(path, "devices/record3d-r3d/scan.r3d");
  expectRecording(path,
                  {.kind = "Record3D", .frames = 16, .color = {960, 720}, .focal_px = 723.8271F * 256 / 960});
}

TEST(PhoneRecordings, ReadsArkitScenes) {
  SCANTROVE_NEED_RECORDING(path, "devices/arkitscenes/41069021_frames");
  expectRecording(path, {.kind = "ARKitScenes", .frames = 16, .color = {256, 192}, .focal_px = 193.0206F});
}

TEST(PhoneRecordings, ReadsTransformsWithDepth) {
  SCANTROVE_NEED_RECORDING(path, "devices/nerfstudio");
  expectRecording(
      path, {.kind = "transforms.json", .frames = 16, .has_confidence = false, .focal_px = kChairFocal_px});
}

TEST(PhoneRecordings, ReadsLidarShot) {
  SCANTROVE_NEED_RECORDING(path, "devices/lidar-tiff");
  SourceOptions options;
  options.intrinsics = Intrinsics{200, 200, 127.5F, 95.5F, 0, 0};
  const auto source = openInput(path.string(), options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().kind, "LiDAR shots");
  EXPECT_FALSE((*source)->info().has_poses);
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
  EXPECT_EQ(read.frame.color.size(), cv::Size(1920, 1440));
  double nearest = 0, farthest = 0;
  cv::minMaxLoc(read.frame.depth, &nearest, &farthest);
  EXPECT_NEAR(nearest * read.frame.meters_per_unit, 0.18, 0.01);
  EXPECT_NEAR(farthest * read.frame.meters_per_unit, 0.57, 0.01);
  EXPECT_EQ((*source)->next().status, FrameRead::Status::end);
}

TEST(PhoneRecordings, TellsAllFormatsFromNumberedImages) {
  SCANTROVE_NEED_RECORDING(path, "devices/stray");
  const auto is_recording = isRecordingFolder(path);
  ASSERT_TRUE(is_recording) << is_recording.error().message();
  EXPECT_TRUE(*is_recording);
}

}  // namespace
}  // namespace scantrove
