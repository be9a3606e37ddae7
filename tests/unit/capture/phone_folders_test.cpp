// Folders of phones with an image for each frame, written as their apps document them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/json_file.h"
#include "core/capture/open_input.h"
#include "tests/support/tiny_video.h"
#include "tests/unit/capture/phone_files.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

void writeScannerAppFrame(const TemporaryFolder& folder, int number, bool has_color) {
  folder.write(numbered("frame_%05d.json", number), std::string(R"({"time": 5, "cameraPoseARFrame": )") +
                                                        kArkitRows + R"(, "intrinsics": )" + kIntrinsicRows +
                                                        "}");
  writeImage(folder / numbered("depth_%05d.png", number), tinyDepth(1500, kLidarSize));
  writeImage(folder / numbered("conf_%05d.png", number), confidenceImage(0, 1, 2));
  if (has_color) writeImage(folder / numbered("frame_%05d.jpg", number), tinyColor(number, kColorSize));
}

TEST(PhoneFolders, Reads3dScannerApp) {
  const TemporaryFolder folder;
  for (int i = 0; i < 4; ++i) writeScannerAppFrame(folder, i, i % 3 == 0);
  folder.write("info.json", "{}");
  const auto frames = framesOf(folder.path(), "3D Scanner App");
  ASSERT_EQ(frames.size(), 4U);
  for (const RgbdFrame& frame : frames) {
    expectPose(frame);
    expectSensorIntrinsics(frame);
    expectConfidence(frame);
    EXPECT_EQ(frame.color.empty(), frame.index % 3 != 0);
    EXPECT_NEAR(middleDepth_m(frame), 1.5, 1e-6);
    EXPECT_EQ(frame.timestamp_s, 5);
  }
}

TEST(PhoneFolders, SaysWhy_When3dScannerAppHasNoDepth) {
  const TemporaryFolder folder;
  writeScannerAppFrame(folder, 0, true);
  std::filesystem::remove(folder / "depth_00000.png");
  EXPECT_THAT(openError(folder.path()), HasSubstr("high-resolution"));
}

TEST(PhoneFolders, LeavesOutFramesWithDamagedMetadata) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) writeScannerAppFrame(folder, i, true);
  folder.write("frame_00001.json", "{\"time\": 5, ");
  EXPECT_EQ(framesOf(folder.path(), "3D Scanner App").size(), 2U);
}

TEST(PhoneFolders, SkipsFramesWithAnImpossibleCamera) {
  const TemporaryFolder folder;
  for (int i = 0; i < 2; ++i) writeScannerAppFrame(folder, i, true);
  folder.write("frame_00001.json", std::string(R"({"cameraPoseARFrame": )") + kArkitRows +
                                       R"(, "intrinsics": [0, 0, 9, 0, 0, 9, 0, 0, 1]})");
  const auto source = openInput(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 2U);
  EXPECT_EQ(reads[0].status, FrameRead::Status::frame);
  EXPECT_EQ(reads[1].status, FrameRead::Status::skipped);
}

TEST(PhoneFolders, TakesIntrinsicsOfTheUser_InPlaceOfAllFrames) {
  const TemporaryFolder folder;
  writeScannerAppFrame(folder, 0, true);
  SourceOptions options;
  options.intrinsics = Intrinsics{210, 211, 128, 96, 0, 0};
  const auto frames = framesOf(folder.path(), "3D Scanner App", options);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_FALSE(frames.front().intrinsics);
}

constexpr const char* kStrayHeader = "timestamp, frame, x, y, z, qx, qy, qz, qw";
/// T_world_camera with OpenCV's axes: kArkitQuaternion times a half turn about x.
constexpr const char* kStrayPose = "1, 2, 3, 0.5, 0.5, -0.5, -0.5";

void writeStrayFrames(const TemporaryFolder& folder, int count) {
  for (int i = 0; i < count; ++i) {
    writeImage(folder / numbered("depth/%06d.png", i), tinyDepth(1500, kLidarSize));
    writeImage(folder / numbered("confidence/%06d.png", i), confidenceImage(0, 1, 2));
  }
  folder.write("camera_matrix.csv", "1500.0, 0.0, 959.5\n0.0, 1400.0, 719.5\n0.0, 0.0, 1.0");
}

TEST(PhoneFolders, ReadsStrayScanner_WithOneCameraAndVideo) {
  const TemporaryFolder folder;
  writeStrayFrames(folder, 3);
  writeTinyVideo(folder / "rgb.mp4", 3, 64, 48);
  std::string odometry = std::string(kStrayHeader) + "\n";
  for (int i = 0; i < 3; ++i) odometry += numbered("7.%d, ", i) + numbered("%06d, ", i) + kStrayPose + "\n";
  folder.write("odometry.csv", odometry);
  SourceOptions options;
  options.start = 1;
  const auto frames = framesOf(folder.path(), "Stray Scanner", options);
  ASSERT_EQ(frames.size(), 2U);
  for (const RgbdFrame& frame : frames) {
    expectPose(frame);
    expectConfidence(frame);
    EXPECT_FALSE(frame.intrinsics);
    EXPECT_NEAR(frame.timestamp_s, 7 + 0.1 * frame.index, 1e-9);
    EXPECT_NEAR(frame.color.at<cv::Vec3b>(24, 32)[1], greyOfTinyVideo(frame.index), 3);
  }
  const auto source = openInput(folder.path().string(), {});
  ASSERT_TRUE(source);
  EXPECT_NEAR((*source)->info().intrinsics.fx, 200, 1e-3);
  EXPECT_NEAR((*source)->info().intrinsics.cy, 95.5, 1e-3);
}

TEST(PhoneFolders, ReadsStrayScanner_WithACameraForEachLine) {
  const TemporaryFolder folder;
  writeStrayFrames(folder, 1);
  writeImage(folder / "rgb" / "000000.jpg", tinyColor(3, kColorSize));
  folder.write("odometry.csv", std::string(kStrayHeader) +
                                   ", fx, fy, cx, cy, distortion_center_x, distortion_center_y\n7, 000000, " +
                                   kStrayPose + ", 1530, 1400, 959.5, 719.5, , \n");
  const auto frames = framesOf(folder.path(), "Stray Scanner");
  ASSERT_EQ(frames.size(), 1U);
  expectSensorIntrinsics(frames.front(), 1530);
  expectPose(frames.front());
  EXPECT_FALSE(frames.front().color.empty());
}

TEST(PhoneFolders, ReadsStrayScanner_WithDepthArrays) {
  const TemporaryFolder folder;
  writeStrayFrames(folder, 1);
  std::filesystem::remove(folder / "depth/000000.png");
  folder.write("depth/000000.npy", numpyBytes(tinyDepth(1500, kLidarSize), "<u2"));
  std::filesystem::create_directories(folder / "rgb");
  folder.write("odometry.csv", std::string(kStrayHeader) + "\n7, 000000, " + kStrayPose + "\n");
  const auto frames = framesOf(folder.path(), "Stray Scanner");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_NEAR(middleDepth_m(frames.front()), 1.5, 1e-6);
}

TEST(PhoneFolders, ReadsPolycam_AsItWasOptimized) {
  const TemporaryFolder folder;
  const auto camera = [](const char* x) {
    return std::string(R"({"t_00": 0, "t_01": 0, "t_02": 1, "t_03": )") + x +
           R"(, "t_10": 1, "t_11": 0, "t_12": 0, "t_13": 2, "t_20": 0, "t_21": 1, "t_22": 0, "t_23": 3,
               "fx": 1500, "fy": 1400, "cx": 959.5, "cy": 719.5, "width": 1920, "height": 1440})";
  };
  for (const char* const time : {"9000000", "10000000"}) {
    const std::string name = time;
    folder.write("keyframes/cameras/" + name + ".json", camera("100"));
    folder.write("keyframes/corrected_cameras/" + name + ".json", camera("1"));
    writeImage(folder / ("keyframes/images/" + name + ".jpg"), tinyColor(10, kColorSize));
    writeImage(folder / ("keyframes/corrected_images/" + name + ".jpg"), tinyColor(200, kColorSize));
    writeImage(folder / ("keyframes/depth/" + name + ".png"), tinyDepth(1500, kLidarSize));
    writeImage(folder / ("keyframes/confidence/" + name + ".png"), confidenceImage(0, 127, 255));
  }
  const auto frames = framesOf(folder.path(), "Polycam");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].timestamp_s, 9) << "in the order of times, not of names";
  expectPose(frames[0]);
  expectSensorIntrinsics(frames[0]);
  expectConfidence(frames[0]);
  EXPECT_NEAR(frames[0].color.at<cv::Vec3b>(20, 20)[0], 200, 8);
}

TEST(PhoneFolders, ReadsArkitScenes) {
  const TemporaryFolder folder;
  writeImage(folder / "lowres_depth/41_10.100.png", tinyDepth(1500, kLidarSize));
  writeImage(folder / "lowres_wide/41_10.100.png", tinyColor(5, kLidarSize));
  writeImage(folder / "confidence/41_10.100.png", confidenceImage(0, 1, 2));
  folder.write("lowres_wide_intrinsics/41_10.101.pincam", "256 192 200 186.66667 127.5 95.5\n");
  // The inverse of expectedPose(): a turn of -120 degrees about (1, -1, 1), and R^T (-1, -2, -3).
  const Eigen::Isometry3d T_camera_world = expectedPose().inverse();
  const Eigen::AngleAxisd turn(T_camera_world.linear());
  const Eigen::Vector3d axis = turn.axis() * turn.angle(), t = T_camera_world.translation();
  std::ostringstream line;
  line.precision(17);
  line << "10.1001 " << axis.x() << ' ' << axis.y() << ' ' << axis.z() << ' ' << t.x() << ' ' << t.y() << ' '
       << t.z();
  folder.write("lowres_wide.traj", line.str() + "\n");
  const auto frames = framesOf(folder.path(), "ARKitScenes");
  ASSERT_EQ(frames.size(), 1U);
  expectPose(frames[0]);
  expectSensorIntrinsics(frames[0]);
  expectConfidence(frames[0]);
  EXPECT_FALSE(frames[0].color.empty());
}

TEST(PhoneFolders, LeavesOutPosesOfArkitScenes_WhenTheirTurnIsNotFinite) {
  const TemporaryFolder folder;
  writeImage(folder / "lowres_depth/41_10.100.png", tinyDepth(1500, kLidarSize));
  folder.write("lowres_wide_intrinsics/41_10.100.pincam", "256 192 200 186.66667 127.5 95.5\n");
  folder.write("lowres_wide.traj", "10.1 1e200 0 0 1 2 3\n");  // its length overflows
  const auto frames = framesOf(folder.path(), "ARKitScenes");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_FALSE(frames[0].T_world_camera);
}

TEST(PhoneFolders, CountsTimes_WhereAClockGivesNone) {
  const TemporaryFolder folder;
  for (int i = 0; i < 2; ++i) writeScannerAppFrame(folder, i, true);
  folder.write("frame_00001.json", std::string(R"({"time": 1e300, "cameraPoseARFrame": )") + kArkitRows +
                                       R"(, "intrinsics": )" + kIntrinsicRows + "}");
  const auto frames = framesOf(folder.path(), "3D Scanner App");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].timestamp_s, 0);
  EXPECT_NEAR(frames[1].timestamp_s, 1.0 / 30, 1e-9);
}

TEST(PhoneFolders, RefusesJson_WhenItsValuesWouldFillTheMemory) {
  const TemporaryFolder folder;
  std::string json = "{\"frames\": [[]";
  for (int i = 0; i < 21'000'000; ++i) json += ",0";
  folder.write("transforms.json", json + "]}");
  EXPECT_FALSE(readJson(folder / "transforms.json"));
  EXPECT_THAT(readJson(folder / "transforms.json").error().what, HasSubstr("20 million"));
}

}  // namespace
}  // namespace scantrove
