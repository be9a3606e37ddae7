// Recordings whose given poses are many kilometres from their origin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/capture/pose_files.h"
#include "core/session/open_session.h"
#include "core/session/session_scan.h"
#include "tests/support/scan_runner.h"
#include "tests/support/synthetic_recording.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

constexpr int kFarFrames = 6;
const Eigen::Vector3d kFar(200'000, -30'000, 12);

class FarOriginTest : public testing::Test {
 protected:
  ScanEnding scanAt(const Eigen::Vector3d& origin, const std::string& name) {
    writeRecording(folder_ / (name + ".recording"), smallRecording(), kFarFrames,
                   [&](RgbdFrame& frame) { frame.T_world_camera->translation() += origin; });
    ScanRequest request;
    request.source = (folder_ / (name + ".recording")).string();
    request.poses = ScanRequest::Poses::given;
    request.output_folder = folder_ / name;
    request.database = (folder_ / (name + ".sqlite")).string();
    return runScan(request);
  }
  TemporaryFolder folder_;
};

TEST_F(FarOriginTest, ScanGivesTheSameResultsAsNearTheOrigin) {
  const ScanEnding near = scanAt({0, 0, 0}, "near"), far = scanAt(kFar, "far");
  ASSERT_TRUE(near.report) << near.error;
  ASSERT_TRUE(far.report) << far.error;
  EXPECT_EQ(far.report->frames.tracked, kFarFrames);
  // The shift is no multiple of a brick, so the brick counts differ slightly.
  EXPECT_NEAR(far.report->map_bricks, near.report->map_bricks, 0.1 * near.report->map_bricks);
  EXPECT_NEAR(far.report->regions, near.report->regions, 1);
  EXPECT_EQ(near.report->origin_m, Eigen::Vector3d::Zero());
  EXPECT_LT((far.report->origin_m - kFar).norm(), 10) << far.report->origin_m.transpose();
}

TEST_F(FarOriginTest, ResultsAreInTheWorldFrameOfTheRecording) {
  ASSERT_TRUE(scanAt(kFar, "far").report);
  const auto trajectory = readTumTrajectory(folder_ / "far" / "trajectory.txt");
  ASSERT_TRUE(trajectory);
  const auto source = makeSyntheticSource(smallRecording()).value();
  ASSERT_EQ(trajectory->size(), static_cast<std::size_t>(kFarFrames));
  for (int i = 0; i < kFarFrames; ++i) {
    const Eigen::Vector3d position = (*trajectory)[static_cast<std::size_t>(i)].T_world_camera.translation();
    EXPECT_LT((position - kFar - source->pose(i).translation()).norm(), 0.002)
        << i;  // written to the millimetre
  }
  EXPECT_THAT(readText(folder_ / "far" / "cloud.ply").substr(0, 300), HasSubstr("property double x"));

  const QtMainThread qt;
  const auto session = OpenSession::open(folder_ / "far", "");
  ASSERT_TRUE(session) << session.error().message();
  SessionScan scan(**session);
  EXPECT_LT((scan.origin() - kFar).norm(), 10);
  const auto stored = scan.trajectory();
  ASSERT_TRUE(stored);
  EXPECT_LT(stored->front().T_world_camera.translation().norm(), 10) << "relative to the origin";
}

TEST_F(FarOriginTest, FramesWithImpossiblePosesAreSkipped) {
  int number = 0;
  writeRecording(folder_ / "rec", smallRecording(), kFarFrames, [&](RgbdFrame& frame) {
    if (++number > 2) frame.T_world_camera->translation().x() = std::pow(10.0, 3 * number);
  });
  ScanRequest request;
  request.source = (folder_ / "rec").string();
  request.poses = ScanRequest::Poses::given;
  request.output_folder = folder_ / "out";
  request.database = (folder_ / "catalogue.sqlite").string();
  const ScanEnding ending = runScan(request);
  ASSERT_TRUE(ending.report) << ending.error;
  EXPECT_EQ(ending.report->frames.tracked, 2);
  ASSERT_EQ(ending.skipped.size(), 4U);
  EXPECT_THAT(ending.skipped.back().error.message(), HasSubstr("where no camera is"));
}

}  // namespace
}  // namespace scantrove::test
