#include <gtest/gtest.h>

#include "core/capture/trajectory_reader.h"
#include "core/exchange/trajectory_writer.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;

Trajectory someTrajectory() {
  Trajectory poses;
  for (int i = 0; i < 20; ++i) {
    StampedPose pose;
    pose.timestamp_s = 1305031225.9334 + i / 30.0;
    pose.T_world_camera = Eigen::Translation3d(0.1 * i, -0.02 * i, 1.5) *
                          Eigen::AngleAxisd(0.4 * i, Eigen::Vector3d(1, 2, 3).normalized());
    poses.push_back(pose);
  }
  return poses;
}

TEST(Trajectory, ReadsBackEqual_WhenWrittenAsTum) {
  const TemporaryFolder folder;
  const Trajectory written = someTrajectory();
  ASSERT_TRUE(writeTumTrajectory(folder / "trajectory.txt", written));
  const auto read = readTrajectory(folder / "trajectory.txt");
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_NEAR((*read)[i].timestamp_s, written[i].timestamp_s, 1e-6);
    EXPECT_TRUE((*read)[i].T_world_camera.isApprox(written[i].T_world_camera, 1e-8));
  }
}

TEST(Trajectory, WritesTheTumLineOfAKnownPose) {
  const TemporaryFolder folder;
  StampedPose pose;
  pose.timestamp_s = 0.5;
  pose.T_world_camera =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(std::acos(-1.0) / 2, Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(writeTumTrajectory(folder / "t.txt", std::vector{pose}));
  EXPECT_EQ(test::readText(folder / "t.txt"),
            "# timestamp tx ty tz qx qy qz qw\n0.500000 1 2 3 0 0 0.707106781 0.707106781\n");
}

TEST(Trajectory, KeepsTenthsOfMicrometersAtUtmCoordinates) {
  const TemporaryFolder folder;
  const Eigen::Vector3d at(691607.1234567, 5334760.7654321, 519.1234567);  // UTM zone 32, metres
  StampedPose pose;
  pose.T_world_camera.translation() = at;
  ASSERT_TRUE(writeTumTrajectory(folder / "t.txt", std::vector{pose}));
  EXPECT_EQ(test::readText(folder / "t.txt"),
            "# timestamp tx ty tz qx qy qz qw\n"
            "0.000000 691607.1234567 5334760.7654321 519.1234567 0 0 0 1\n");
  const auto read = readTrajectory(folder / "t.txt");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_LT((read->front().T_world_camera.translation() - at).norm(), 1e-7);
}

TEST(Trajectory, SortsByTimeAndSkipsPosesThatAreNotFinite) {
  const TemporaryFolder folder;
  const auto path = folder.write("t.txt",
                                 "# comment\n2.0 1 0 0 0 0 0 1 # late\n\n1.0 2 0 0 0 0 0 2\n"
                                 "1.5 nan nan nan 0 0 0 1\n");
  const auto read = readTrajectory(path);
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ((*read)[0].timestamp_s, 1.0);
  EXPECT_TRUE((*read)[0].T_world_camera.linear().isApprox(Eigen::Matrix3d::Identity()));
}

TEST(Trajectory, ReadsPoses_WhenTheFolderIs7Scenes) {
  const TemporaryFolder folder;
  const std::string matrix = "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  folder.write("frame-000030.pose.txt", matrix);
  folder.write("frame-000060.pose.txt", matrix);
  folder.write("frame-000090.pose.txt", "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\n0 0 0 1\n");
  const auto read = readTrajectory(folder.path());
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ((*read)[0].timestamp_s, 1.0);
  EXPECT_EQ((*read)[1].timestamp_s, 2.0);
  EXPECT_EQ((*read)[1].T_world_camera.translation().x(), 0.25);
}

TEST(Trajectory, ReadsALog_WhenItIsInASubfolder) {
  const TemporaryFolder folder;
  folder.write("test_scene/trajectory.log",
               "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n3 3 4\n1 0 0 7\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const auto read = readTrajectory(folder.path());
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->size(), 2U);
  EXPECT_DOUBLE_EQ((*read)[1].timestamp_s, 0.1);
  EXPECT_EQ((*read)[1].T_world_camera.translation().x(), 7);
}

TEST(Trajectory, ReadsNanosecondsAsSeconds) {
  const TemporaryFolder folder;
  const auto read = readTrajectory(folder.write(
      "groundtruth.txt", "1403636579763555584 1 0 0 0 0 0 1\n1403636579813555456 2 0 0 0 0 0 1\n"));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_NEAR((*read)[0].timestamp_s, 1403636579.763555584, 1e-6);
  EXPECT_NEAR((*read)[1].timestamp_s - (*read)[0].timestamp_s, 0.05, 1e-6);
}

TEST(Trajectory, KeepsTimes_WhenPosesAreFewOrFramesAreCounted) {
  const TemporaryFolder folder;
  for (const char* later : {"10", "600", "0.0005"}) {
    const auto read =
        readTrajectory(folder.write("t.txt", "0 1 0 0 0 0 0 1\n" + std::string(later) + " 2 0 0 0 0 0 1\n"));
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ((*read)[1].timestamp_s, std::stod(later));
  }
}

TEST(Trajectory, ReadsText_WhenItBeginsWithAByteOrderMark) {
  const TemporaryFolder folder;
  const std::string matrix = "1 0 0 0.25\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"t.txt", "1 0.25 0 0 0 0 0 1\n"},
                                   {"comment.txt", "# poses\n1 0.25 0 0 0 0 0 1\n"},
                                   {"t.log", "30 30 31\n" + matrix},
                                   {"scenes/frame-000030.pose.txt", matrix}}) {
    SCOPED_TRACE(name);
    const auto file = folder.write(name, "\xEF\xBB\xBF" + text);
    const auto read = readTrajectory(name.starts_with("scenes") ? file.parent_path() : file);
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->size(), 1U);
    EXPECT_EQ(read->front().timestamp_s, 1);
    EXPECT_EQ(read->front().T_world_camera.translation().x(), 0.25);
  }
}

TEST(Trajectory, NamesTheFile_WhenItIsUtf16) {
  const TemporaryFolder folder;
  const auto bad = readTrajectory(folder.write("t.txt", std::string("\xFF\xFE\x31\0\x20\0", 6)));
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message().find("UTF-8"), std::string::npos) << bad.error().message();
}

TEST(Trajectory, NamesTheLine_WhenItIsMalformed) {
  const TemporaryFolder folder;
  const auto bad = readTrajectory(folder.write("t.txt", "1 0 0 0 0 0 0 1\n2 0 0\n"));
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().what.find("t.txt, line 2"), std::string::npos);
  const auto empty = readTrajectory(folder.write("e.txt", "# nothing\n"));
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().what.find("e.txt"), std::string::npos);
  const auto missing = readTrajectory(folder / "missing.txt");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().what.find("missing.txt"), std::string::npos);
  const TemporaryFolder without_poses;
  EXPECT_NE(readTrajectory(without_poses.path()).error().advice.find("groundtruth.txt"), std::string::npos);
}

}  // namespace
}  // namespace scantrove
