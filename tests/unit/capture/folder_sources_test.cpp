// The three folder layouts, with recordings of a few small frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/numbered_folder.h"
#include "core/capture/time_association.h"
#include "core/capture/tum_folder.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;
using Status = FrameRead::Status;

TEST(SevenScenes, ReadsNumbersTimesPosesAndDefaultCamera) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 500, 3);
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "7-Scenes");
  EXPECT_EQ(info.frame_count, 3);
  EXPECT_TRUE(info.has_poses);
  EXPECT_FALSE(info.is_live);
  EXPECT_EQ(info.intrinsics, (Intrinsics{585, 585, 320, 240, 640, 480}.resizedTo(kTinyWidth, kTinyHeight)));
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const RgbdFrame& frame = reads[static_cast<std::size_t>(i)].frame;
    EXPECT_EQ(frame.index, 500 + i);
    EXPECT_DOUBLE_EQ(frame.timestamp_s, (500 + i) / 30.0);
    EXPECT_EQ(frame.depth.at<std::uint16_t>(10, 10), 1500 + i);
    EXPECT_EQ(frame.color.at<cv::Vec3b>(10, 10),
              cv::Vec3b(static_cast<uchar>(500 + i > 255 ? 255 : 500 + i), 20, 30));
    EXPECT_FLOAT_EQ(frame.meters_per_unit, 0.001F);
    ASSERT_TRUE(frame.T_world_camera);
    EXPECT_DOUBLE_EQ(frame.T_world_camera->translation().x(), 0.01 * (500 + i));
  }
}

TEST(SevenScenes, MapsInvalidDepthToZero) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 1);
  cv::Mat depth = tinyDepth(1200);
  depth.at<std::uint16_t>(3, 4) = 65535;
  depth.at<std::uint16_t>(3, 5) = 65534;
  writeImage(folder / "frame-000000.depth.png", depth);
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source);
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(3, 4), 0);
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(3, 5), 65534);
}

TEST(SevenScenes, ReadsTheCameraFile_WhenThereIsOne) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 1);
  folder.write("camera-intrinsics.txt", "50 0 31\n0 51 23\n0 0 1\n");
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{50, 51, 31, 23, kTinyWidth, kTinyHeight}));
}

TEST(SevenScenes, ReturnsFramesWithoutPose_WhenPosesAreUnusable) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 5);
  folder.write("frame-000001.pose.txt", "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\n0 0 0 1\n");
  folder.write("frame-000002.pose.txt", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");              // not rigid
  folder.write("frame-000003.pose.txt", "-1.#IND -1.#IND 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");  // Windows' NaN
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source);
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 5U);
  const std::vector<bool> expected = {true, false, false, false, true};
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].status, Status::frame);
    EXPECT_EQ(reads[i].frame.T_world_camera.has_value(), expected[i]) << i;
  }
}

TEST(SevenScenes, SkipsTheFrame_WhenAnImageIsMissing) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 4);
  std::filesystem::remove(folder / "frame-000001.depth.png");
  std::filesystem::remove(folder / "frame-000002.color.png");
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source);
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 4U);
  EXPECT_EQ(reads[1].status, Status::skipped);
  EXPECT_THAT(reads[1].error.what, HasSubstr("Frame 1 has no depth"));
  EXPECT_EQ(reads[2].status, Status::skipped);
  EXPECT_THAT(reads[2].error.what, HasSubstr("Frame 2 has no colour"));
  EXPECT_EQ(reads[3].status, Status::frame);
}

TEST(SevenScenes, NamesASequence_WhenTheFolderContainsSequences) {
  const TemporaryFolder folder;
  writeSevenScenes(folder / "seq-01", 0, 1);
  EXPECT_THAT(openError(folder.path()), HasSubstr((folder / "seq-01").string()));
}

TEST(SourceOptions, SelectFramesByStartStrideAndCount) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 100, 10);
  SourceOptions options;
  options.start = 2;
  options.stride = 3;
  options.frames = 2;
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().frame_count, 2);
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 2U);
  EXPECT_EQ(reads[0].frame.index, 102);
  EXPECT_EQ(reads[1].frame.index, 105);
}

/// Two cameras whose clocks differ by 5 ms, one colour image lost.
void writeTum(const TemporaryFolder& folder, const std::string& camera = "freiburg2") {
  std::ostringstream rgb, depth, truth;
  rgb << "# color images\n# file: 'rgbd_dataset_" << camera << "_desk.bag'\n";
  depth << "# depth maps\n";
  truth << "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < 5; ++i) {
    const std::string time = numbered("1305031229.%06d", i * 33333);
    depth << time << " depth/" << time << ".png\n";
    writeImage(folder / "depth" / (time + ".png"), tinyDepth(5000 + i));
    if (i != 2) {
      const std::string color_time = numbered("1305031229.%06d", i * 33333 + 5000);
      rgb << color_time << " rgb/" << color_time << ".png\n";
      writeImage(folder / "rgb" / (color_time + ".png"), tinyColor(i));
    }
  }
  for (int i = 0; i < 9; ++i) {  // x moves by 1 m/s, 14 ms steps; ends 21 ms before the last image
    truth << "1305031229." << numbered("%03d", i * 14) << ' ' << i * 14e-3 << " 0 0 0 0 0 1\n";
  }
  folder.write("rgb.txt", rgb.str());
  folder.write("depth.txt", depth.str());
  folder.write("groundtruth.txt", truth.str());
}

TEST(TumFolder, PairsImagesAndInterpolatesPoses) {
  const TemporaryFolder folder;
  writeTum(folder);
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "TUM RGB-D");
  EXPECT_TRUE(info.has_poses);
  const Intrinsics freiburg2{520.9F, 521.0F, 325.1F, 249.7F, 640, 480};
  EXPECT_EQ(info.intrinsics, freiburg2.resizedTo(kTinyWidth, kTinyHeight));
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 4U);  // the depth image without a partner is skipped
  const std::vector<int> original = {0, 1, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    const RgbdFrame& frame = reads[i].frame;
    EXPECT_EQ(frame.index, static_cast<int>(i));
    EXPECT_NEAR(frame.timestamp_s, 1305031229.0 + original[i] * 0.033333, 1e-6);
    const cv::Point middle(kTinyWidth / 2, kTinyHeight / 2);
    EXPECT_EQ(frame.depth.at<std::uint16_t>(middle), 5000 + original[i]);
    EXPECT_EQ(frame.color.at<cv::Vec3b>(middle)[0], original[i]);
    EXPECT_FLOAT_EQ(frame.meters_per_unit, 1.0F / 5000);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(reads[i].frame.T_world_camera) << i;
    EXPECT_NEAR(reads[i].frame.T_world_camera->translation().x(), original[i] * 0.033333, 1e-5) << i;
  }
  EXPECT_FALSE(reads[3].frame.T_world_camera);  // 21 ms after the last pose
}

// The lenses of the first two cameras cover less than a pinhole in the corners.
TEST(TumFolder, UndistortsImages_WhenTheCameraIsKnown) {
  for (const auto& [camera, is_bent] :
       {std::pair("freiburg1", true), {"freiburg2", true}, {"freiburg3", false}}) {
    SCOPED_TRACE(camera);
    const TemporaryFolder folder;
    writeTum(folder, camera);
    const auto source = openSource(folder.path().string(), {});
    ASSERT_TRUE(source) << source.error().message();
    const RgbdFrame frame = (*source)->next().frame;
    EXPECT_EQ(frame.depth.at<std::uint16_t>(0, 0) == 0, is_bent);
    EXPECT_EQ(frame.depth.at<std::uint16_t>(kTinyHeight / 2, kTinyWidth / 2), 5000);
  }
}

TEST(TumFolder, UndistortsNothing_WhenIntrinsicsAreAnotherCameras) {
  const TemporaryFolder folder;
  writeTum(folder);
  SourceOptions options;
  options.intrinsics = Intrinsics{60, 60, 32, 24, 0, 0};
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->next().frame.depth.at<std::uint16_t>(0, 0), 5000);
}

TEST(TumFolder, Warns_WhenTheCameraIsUnknown) {
  const TemporaryFolder folder;
  writeTum(folder);
  folder.write("rgb.txt", "# color images\n1305031229.005000 rgb/1305031229.005000.png\n");
  const CapturedLog log;
  ASSERT_TRUE(openSource(folder.path().string(), {}));
  EXPECT_THAT(log.text(), HasSubstr("--intrinsics"));
}

TEST(TumFolder, AssociatesClosestPairsFirstAndEachImageOnce) {
  const auto pairs = associateTimes({0.000, 0.010, 0.100}, {0.009, 0.095, 0.130}, 0.02);
  const std::vector<std::pair<std::size_t, std::size_t>> expected = {{1, 0}, {2, 1}};
  EXPECT_EQ(pairs, expected);
}

TEST(TumFolder, Fails_WhenNothingCanBePaired) {
  const TemporaryFolder folder;
  folder.write("depth.txt", "1.0 depth/1.png\n");
  folder.write("rgb.txt", "2.0 rgb/2.png\n");
  EXPECT_THAT(openError(folder.path()), HasSubstr("clock"));
}

TEST(TumFolder, NamesTheLine_WhenItIsMalformed) {
  const TemporaryFolder folder;
  folder.write("depth.txt", "# depth\n1.0 depth/1.png\nnonsense\n");
  EXPECT_THAT(openError(folder.path()), HasSubstr("line 3"));
}

TEST(NumberedFolder, PairsByNumber_WhenDigitsAndFormatsDiffer) {
  const TemporaryFolder folder;
  for (int i = 8; i < 12; ++i) {  // 8 ... 11: as text, "10" sorts before "8"
    writeImage(folder / "image" / numbered("%d.jpg", i), tinyColor(100));
    writeImage(folder / "depth" / numbered("frame-%06d.png", i), tinyDepth(1000 + i));
  }
  std::filesystem::remove(folder / "image" / "9.jpg");
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().kind, "numbered images");
  EXPECT_FALSE((*source)->info().has_poses);
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{525, 525, 319.5, 239.5, 640, 480}.resizedTo(64, 48)));
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_EQ(reads[0].frame.index, 8);
  EXPECT_EQ(reads[1].frame.index, 10);
  EXPECT_EQ(reads[2].frame.depth.at<std::uint16_t>(5, 5), 1011);
  EXPECT_DOUBLE_EQ(reads[2].frame.timestamp_s, 11 / 30.0);
  EXPECT_THAT(log.text(), HasSubstr("525,525,319.5,239.5"));
}

TEST(NumberedFolder, OverridesDefaultsWithoutWarning_WhenOptionsAreGiven) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 2);
  SourceOptions options;
  options.intrinsics = Intrinsics{60, 61, 32, 24, 0, 0};
  options.depth_scale = 500;
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{60, 61, 32, 24, kTinyWidth, kTinyHeight}));
  EXPECT_FLOAT_EQ((*source)->next().frame.meters_per_unit, 0.002F);
  EXPECT_THAT(log.text(), IsEmpty());
}

TEST(NumberedFolder, ReadsOpen3dCameraColumnByColumn) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 1);
  folder.write(
      "intrinsic.json",
      R"({"width": 64, "height": 48, "depth_scale": 4000, "intrinsic_matrix": [60, 0, 0, 0, 61, 0, 31, 23, 1]})");
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{60, 61, 31, 23, kTinyWidth, kTinyHeight}));
  EXPECT_FLOAT_EQ((*source)->next().frame.meters_per_unit, 1.0F / 4000);
}

TEST(NumberedFolder, ReadsDepthAlone_WhenColorIsMissing) {
  const TemporaryFolder folder;
  writeImage(folder / "depth" / "00000.png", tinyDepth(1000));
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, Status::frame);
  EXPECT_TRUE(read.frame.color.empty());
}

TEST(NumberedFolder, KeepsColorSize_WhenItDiffersFromDepth) {
  const TemporaryFolder folder;
  writeImage(folder / "depth" / "00000.png", tinyDepth(1000));
  writeImage(folder / "rgb" / "00000.png", tinyColor(7, {2 * kTinyWidth, 2 * kTinyHeight}));
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source);
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.frame.color.size(), cv::Size(2 * kTinyWidth, 2 * kTinyHeight));
  EXPECT_EQ(read.frame.color.at<cv::Vec3b>(4, 4), cv::Vec3b(7, 20, 30));
  EXPECT_FALSE(read.frame.color_camera) << "registered";
}

TEST(NumberedFolder, AcceptsAnotherColorShape_WhenItsCameraIsGiven) {
  const TemporaryFolder folder;
  writeImage(folder / "color/0.png", tinyColor(1, {128, 72}));
  writeImage(folder / "depth/0.png", tinyDepth(1000));
  ColorCamera camera{{100, 100, 64, 36, 0, 0}};
  camera.T_color_depth.translation().x() = -0.02;
  SourceOptions options;
  options.color_registration = ColorRegistration{camera};
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source) << source.error().message();
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame);
  EXPECT_EQ(read.frame.color.size(), cv::Size(128, 72));
  ASSERT_TRUE(read.frame.color_camera);
  EXPECT_EQ(read.frame.color_camera->K, (Intrinsics{100, 100, 64, 36, 128, 72}));
  EXPECT_TRUE(read.frame.color_camera->T_color_depth.isApprox(camera.T_color_depth));
}

TEST(NumberedFolder, ReadsPoses_WhenThereIsATrajectoryLog) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 500, 3);  // the log counts from 0
  std::string log;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    log += n + " " + n + " " + n + "\n1 0 0 " + n + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  }
  folder.write("test_scene/trajectory.log", log);
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_TRUE((*source)->info().has_poses);
  const auto reads = readAll(**source);
  ASSERT_EQ(reads.size(), 3U);
  ASSERT_TRUE(reads[2].frame.T_world_camera);
  EXPECT_EQ(reads[2].frame.T_world_camera->translation().x(), 2);
}

TEST(NumberedFolder, FindsTheNumberInAName) {
  EXPECT_EQ(numberInName("000500", DigitRun::last), 500);
  EXPECT_EQ(numberInName("frame-000012", DigitRun::last), 12);
  EXPECT_EQ(numberInName("0000012-000000400012", DigitRun::first), 12);
  EXPECT_EQ(numberInName("12ab34cd", DigitRun::last), 34);
  EXPECT_EQ(numberInName("none", DigitRun::last), std::nullopt);
  EXPECT_EQ(numberInName("99999999999999", DigitRun::last), std::nullopt);
}

TEST(NumberedFolder, PairsByNumber_WhenNamesAlsoContainTimes) {
  const TemporaryFolder folder;
  for (int i = 1; i < 4; ++i) {  // Redwood's scans: number, then a time that differs between the two cameras
    writeImage(folder / "rgb" / (numbered("%07d", i) + numbered("-%012d.png", i * 33369)), tinyColor(i));
    writeImage(folder / "depth" / (numbered("%07d", i) + numbered("-%012d.png", i * 33369 + 7)),
               tinyDepth(1000 + i));
  }
  const auto source = openSource(folder.path().string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ(readAll(**source).back().frame.index, 3);
}

}  // namespace
}  // namespace scantrove
