#include "core/capture/pose_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

TEST(TumTrajectory, SortsNormalizesAndSkipsNan) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.txt",
                                 "# comment\n\n2.5 1 2 3 0 0 2 2\r\n1.5 0 0 0 0 0 0 1\n"
                                 "1.75 nan nan nan 0 0 0 1\n1.8 0 0 0 0 0 0 0\n");
  const auto trajectory = readTumTrajectory(file);
  ASSERT_TRUE(trajectory) << trajectory.error().message();
  ASSERT_EQ(trajectory->size(), 2U);
  EXPECT_EQ((*trajectory)[0].timestamp_s, 1.5);
  EXPECT_EQ((*trajectory)[1].T_world_camera.translation(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d quarter_turn =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).matrix();
  EXPECT_TRUE((*trajectory)[1].T_world_camera.linear().isApprox(quarter_turn, 1e-12));
}

TEST(TumTrajectory, NamesLineOrFile_WhenMalformedOrMissing) {
  const TemporaryFolder folder;
  const auto bad = readTumTrajectory(folder.write("bad.txt", "1 0 0 0 0 0 0 1\n2 0 0 0\n"));
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().what, HasSubstr("bad.txt, line 2"));
  const auto missing = readTumTrajectory(folder / "missing.txt");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().what, HasSubstr("missing.txt"));
  EXPECT_FALSE(readTumTrajectory(folder.write("empty.txt", "# nothing\n")));
}

TEST(TrajectoryLog, ReadsBlocksOfFiveLines) {
  const TemporaryFolder folder;
  const auto poses = readTrajectoryLog(folder.write(
      "t.log", "3 3 4\n1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n4 4 5\n0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\n"));
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 1U);  // the all-zero matrix is no motion
  EXPECT_EQ(poses->front().number, 3);
  EXPECT_EQ(poses->front().T_world_camera.translation(), Eigen::Vector3d(7, 8, 9));
  EXPECT_FALSE(readTrajectoryLog(folder.write("short.log", "0 0 1\n1 0 0 0\n")));
}

TEST(RigidMotion, AcceptsRoundedRotationsAndReturnsExactOnes) {
  Eigen::Matrix4d rounded = Eigen::Matrix4d::Identity();
  rounded.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix() +
                                  Eigen::Matrix3d::Constant(1e-4);
  const auto motion = rigidMotion(rounded);
  ASSERT_TRUE(motion);
  EXPECT_TRUE((motion->linear().transpose() * motion->linear()).isIdentity(1e-12));
  Eigen::Matrix4d mirrored = Eigen::Matrix4d::Identity();
  mirrored(0, 0) = -1;
  EXPECT_FALSE(rigidMotion(mirrored));
}

TEST(PoseFiles, MakesAMotionOfARotationAndATranslation) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto motion = rigidMotion(turn, Eigen::Vector3d(1, 2, 3));
  ASSERT_TRUE(motion);
  EXPECT_TRUE(motion->linear().isApprox(turn));
  EXPECT_EQ(motion->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(rigidMotion(2 * turn, Eigen::Vector3d::Zero()));
}

}  // namespace
}  // namespace scantrove
