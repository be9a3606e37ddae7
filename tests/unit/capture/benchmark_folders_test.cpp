// Small folders in the layouts of benchmarks, written after their documents.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/open_input.h"
#include "core/capture/trajectory_reader.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/benchmark_folder.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;

/// Eleven frames, so that names without leading zeros sort differently as text.
void writeScannet(const TemporaryFolder& folder) {
  for (int i = 0; i < 11; ++i) {
    writeImage(folder / ("color/" + std::to_string(i) + ".jpg"), tinyColor(i, {128, 96}));
    writeImage(folder / ("depth/" + std::to_string(i) + ".png"), tinyDepth(1000 + i));
    folder.write("pose/" + std::to_string(i) + ".txt",
                 i == 3
                     ? "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
                     : matrixText(0.1 * i));
  }
  folder.write("intrinsic/intrinsic_depth.txt", "60 0 31.5 0\n0 61 23.5 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("intrinsic/intrinsic_color.txt", "120 0 64 0\n0 121 48 0\n0 0 1 0\n0 0 0 1\n");
  for (const char* const name : {"color", "depth"})
    folder.write("intrinsic/extrinsic_" + std::string(name) + ".txt", matrixText(0));
}

TEST(ScannetFolder, ReadsTwoCamerasAndPoses) {
  const TemporaryFolder folder;
  writeScannet(folder);
  const CapturedLog log;
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "ScanNet");
  EXPECT_TRUE(source->info().has_poses);
  EXPECT_EQ(source->info().pose_origin, PoseOrigin::truth);
  EXPECT_EQ(source->info().intrinsics, (Intrinsics{60, 61, 31.5F, 23.5F, 64, 48}));
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 11U);
  for (int i = 0; i < 11; ++i) {
    const RgbdFrame& frame = reads[static_cast<std::size_t>(i)].frame;
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.depth.at<std::uint16_t>(5, 5), 1000 + i);
    ASSERT_TRUE(frame.color_camera);
    EXPECT_EQ(frame.color_camera->K, (Intrinsics{120, 121, 64, 48, 128, 96}));
    EXPECT_EQ(frame.T_world_camera.has_value(), i != 3);
    if (frame.T_world_camera) {
      EXPECT_NEAR(frame.T_world_camera->translation().x(), 0.1 * i, 1e-9);
    }
  }
  EXPECT_THAT(log.text(), IsEmpty());
}

TEST(ScannetFolder, ReadsTheLayoutOf25kFrames) {
  const TemporaryFolder folder;
  writeImage(folder / "color/000100.jpg", tinyColor(1, {128, 96}));
  writeImage(folder / "depth/000100.png", tinyDepth(1500));
  folder.write("pose/000100.txt", matrixText(2));
  folder.write("intrinsics_depth.txt", "60 0 31.5 0\n0 61 23.5 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("intrinsics_color.txt", "120 0 64 0\n0 121 48 0\n0 0 1 0\n0 0 0 1\n");
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "ScanNet");
  const FrameRead read = source->next();
  ASSERT_TRUE(read.frame.T_world_camera);
  EXPECT_EQ(read.frame.T_world_camera->translation().x(), 2);
  EXPECT_EQ(source->info().intrinsics.fy, 61);
}

/// One line of traj.txt for each of `lines`; images for frames 0, 1, 2.
void writeReplica(const TemporaryFolder& folder, int lines) {
  std::string poses;
  for (int i = 0; i < lines; ++i) poses += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0 0 0 0 1\n";
  folder.write("room0/traj.txt", poses);
  for (int i = 0; i < 3; ++i) {
    writeImage(folder / numbered("room0/results/frame%06d.jpg", i), tinyColor(i));
    writeImage(folder / numbered("room0/results/depth%06d.png", i), tinyDepth(13107));
  }
}

TEST(ReplicaFolder, ReadsTheCameraBesideTheScene) {
  const TemporaryFolder folder;
  writeReplica(folder, 3);
  folder.write(
      "cam_params.json",
      R"({"camera": {"w": 64, "h": 48, "fx": 60, "fy": 61, "cx": 31.5, "cy": 23.5, "scale": 6553.5}})");
  const auto source = openBenchmark(folder / "room0");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "Replica");
  EXPECT_EQ(source->info().intrinsics, (Intrinsics{60, 61, 31.5F, 23.5F, 64, 48}));
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_NEAR(
      reads[2].frame.depth.at<std::uint16_t>(5, 5) * static_cast<double>(reads[2].frame.meters_per_unit), 2,
      1e-5);
  ASSERT_TRUE(reads[2].frame.T_world_camera);
  EXPECT_EQ(reads[2].frame.T_world_camera->translation().x(), 2);
}

TEST(ReplicaFolder, TakesPosesByNumber_WhenImagesWereRemoved) {
  const TemporaryFolder folder;
  writeReplica(folder, 10);
  std::filesystem::remove(folder / "room0/results/frame000001.jpg");
  std::filesystem::remove(folder / "room0/results/depth000001.png");
  SourceOptions options;
  options.intrinsics = Intrinsics{60, 60, 32, 24, 0, 0};
  const auto source = openBenchmark(folder / "room0", options);
  ASSERT_TRUE(source);
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 2U);
  EXPECT_EQ(reads[1].frame.index, 2);
  EXPECT_EQ(reads[1].frame.T_world_camera->translation().x(), 2);
}

TEST(ReplicaFolder, AsksForTheCamera_WhenImagesHaveAnotherSize) {
  const TemporaryFolder folder;
  writeReplica(folder, 3);
  EXPECT_THAT(openError(folder / "room0"), AllOf(HasSubstr("64x48"), HasSubstr("--intrinsics")));
}

TEST(FoundationPoseFolder, ReadsNamesOfNineteenDigits) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    const std::string name = numbered("15811204241%08d.png", i * 33'333'333 % 100'000'000);
    writeImage(folder / ("rgb/" + name), tinyColor(i));
    writeImage(folder / ("depth/" + name), tinyDepth(800 + i));
    writeImage(folder / ("masks/" + name), tinyDepth(1));
  }
  folder.write("cam_K.txt", "60 0 31.5\n0 61 23.5\n0 0 1\n");
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "FoundationPose");
  EXPECT_FALSE(source->info().has_poses);
  EXPECT_EQ(source->info().intrinsics, (Intrinsics{60, 61, 31.5F, 23.5F, 64, 48}));
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_NEAR(reads[1].frame.timestamp_s - reads[0].frame.timestamp_s, 1 / 30.0, 1e-3);
  EXPECT_EQ(reads[2].frame.depth.at<std::uint16_t>(5, 5), 802);
}

TEST(SceneNnFolder, ReadsFilesFromOne_AndALogFromZero) {
  const TemporaryFolder folder;
  std::string log;
  for (int i = 1; i <= 3; ++i) {
    writeImage(folder / numbered("image/image%05d.png", i), tinyColor(i, {640, 480}));
    writeImage(folder / numbered("depth/depth%05d.png", i), tinyDepth(1500 + i, {640, 480}));
    log += numbered("%d ", i - 1) + numbered("%d ", i - 1) + numbered("%d\n", i) + matrixText(i);
  }
  folder.write("trajectory.log", log);
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "SceneNN");
  EXPECT_EQ(source->info().intrinsics, (Intrinsics{544.47329F, 544.47329F, 320, 240, 640, 480}));
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(reads[static_cast<std::size_t>(i)].frame.T_world_camera);
    EXPECT_EQ(reads[static_cast<std::size_t>(i)].frame.T_world_camera->translation().x(), i + 1);
  }
}

void writeIclNuim(const TemporaryFolder& folder) {
  std::string list;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    writeImage(folder / ("rgb/" + n + ".png"), tinyColor(i, {640, 480}));
    writeImage(folder / ("depth/" + n + ".png"), tinyDepth(10000, {640, 480}));
    list += n + " depth/" + n + ".png " + n + " rgb/" + n + ".png\n";
  }
  folder.write("associations.txt", list);
}

/// The data set's camera sees a point at (u, v, z) as ((u - cx) z / fx, (v - cy) z / -480, z). Its pose takes
/// the point to a world, which Scantrove mirrors.
TEST(IclNuimFolder, MirrorsPoses_SoThatPointsAgree) {
  const TemporaryFolder folder;
  writeIclNuim(folder);
  // 30 degrees about x, then a translation; frame 0 has no pose, as in the data set
  folder.write("livingRoom1.gt.freiburg",
               "1 1 2 3 0.25881904510252 0 0 0.96592582628907\n2 0 0 -2.25 0 0 0 1\n");
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "ICL-NUIM");
  EXPECT_EQ(source->info().intrinsics, (Intrinsics{481.2F, 480, 319.5F, 239.5F, 640, 480}));
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 3U);
  EXPECT_FALSE(reads[0].frame.T_world_camera);
  const RgbdFrame& frame = reads[1].frame;
  EXPECT_NEAR(frame.depth.at<std::uint16_t>(0, 0) * static_cast<double>(frame.meters_per_unit), 2, 1e-5);
  ASSERT_TRUE(frame.T_world_camera);
  const double u = 100, v = 400, z = 2;
  const Eigen::Vector3d theirs((u - 319.5) * z / 481.2, (v - 239.5) * z / -480, z);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::AngleAxisd(3.14159265358979 / 6, Eigen::Vector3d::UnitX()));
  T.pretranslate(Eigen::Vector3d(1, 2, 3));
  const Eigen::Vector3d theirs_world = T * theirs;
  const Eigen::Vector3d ours = source->info().intrinsics.backProject(100, 400, 2).cast<double>();
  const Eigen::Vector3d ours_world = *frame.T_world_camera * ours;
  EXPECT_NEAR(ours_world.x(), theirs_world.x(), 1e-5);
  EXPECT_NEAR(ours_world.y(), -theirs_world.y(), 1e-5);
  EXPECT_NEAR(ours_world.z(), theirs_world.z(), 1e-5);

  const auto truth = readTrajectory(folder.path());
  ASSERT_TRUE(truth) << truth.error().message();
  ASSERT_EQ(truth->size(), 2U);
  EXPECT_DOUBLE_EQ((*truth)[0].timestamp_s, 1 / 30.0);
  EXPECT_TRUE((*truth)[0].T_world_camera.isApprox(*frame.T_world_camera));
}

TEST(IclNuimFolder, KeepsPoses_WhenACameraFileHasYDown) {
  const TemporaryFolder folder;
  writeIclNuim(folder);
  folder.write("traj1.gt.freiburg", "1 1 2 3 0 0 0 1\n");
  for (const double sign : {1.0, -1.0}) {
    folder.write("camera-intrinsics.txt", "481 0 320\n0 " + std::to_string(sign * 479) + " 240\n0 0 1\n");
    const auto source = openBenchmark(folder.path());
    ASSERT_TRUE(source);
    EXPECT_EQ(source->info().intrinsics.fy, 479);
    EXPECT_EQ(readAll(*source)[1].frame.T_world_camera->translation(), Eigen::Vector3d(1, 2 * sign, 3));
  }
}

TEST(BonnFolder, HasTheDataSetsCameraAndNoPoses) {
  const TemporaryFolder folder;
  const std::string sequence = "rgbd_bonn_balloon/";
  std::string rgb, depth;
  for (int i = 0; i < 3; ++i) {
    const std::string time = numbered("1548266532.%02d", 3 * i);
    writeImage(folder / (sequence + "rgb/" + time + ".png"), tinyColor(i, {640, 480}));
    writeImage(folder / (sequence + "depth/" + time + ".png"), tinyDepth(10000, {640, 480}));
    rgb += time + " rgb/" + time + ".png\n";
    depth += time + " depth/" + time + ".png\n";
  }
  folder.write(sequence + "rgb.txt", rgb);
  folder.write(sequence + "depth.txt", depth);
  folder.write(sequence + "groundtruth.txt", "1548266532.00 0 0 0 0 0 0 1\n1548266532.03 0 0 0 0 0 0 1\n");
  const auto source = openBenchmark(folder / "rgbd_bonn_balloon");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "Bonn RGB-D");
  EXPECT_EQ(source->info().intrinsics,
            (Intrinsics{542.822841F, 542.576870F, 315.593520F, 237.756098F, 640, 480}));
  EXPECT_FALSE(source->info().has_poses);
  EXPECT_FLOAT_EQ(source->next().frame.meters_per_unit, 1 / 5000.0F);
}

TEST(NumberedFolder, ReadsPosesOfAPoseFolder) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 2);
  folder.write("pose/000001.txt", matrixText(3));
  SourceOptions options;
  options.intrinsics = Intrinsics{60, 60, 32, 24, 0, 0};
  const auto source = openBenchmark(folder.path(), options);
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "numbered images");
  const auto reads = readAll(*source);
  ASSERT_EQ(reads.size(), 2U);
  EXPECT_FALSE(reads[0].frame.T_world_camera);
  ASSERT_TRUE(reads[1].frame.T_world_camera);
}

TEST(FolderFormats, SaysWhichIsTaken_WhenTwoFit) {
  const TemporaryFolder folder;
  writeScannet(folder);
  writeImage(folder / "rgb/0.png", tinyColor(1));
  folder.write("cam_K.txt", "60 0 31.5\n0 61 23.5\n0 0 1\n");
  const CapturedLog log;
  const auto source = openBenchmark(folder.path());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().kind, "ScanNet");
  EXPECT_THAT(log.text(), HasSubstr("fits two formats, ScanNet and FoundationPose; it is opened as ScanNet"));
}

TEST(FolderFormats, AreRecordings) {
  const TemporaryFolder folder;
  writeReplica(folder, 3);
  const auto is_recording = isRecordingFolder(folder / "room0");
  ASSERT_TRUE(is_recording);
  EXPECT_TRUE(*is_recording);
  EXPECT_THAT(openError(folder.path()), HasSubstr("room0")) << "names the recording inside";
}

}  // namespace
}  // namespace scantrove
