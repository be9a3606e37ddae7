// Scans with the poses of a device that tracks itself.
#include <gtest/gtest.h>

#include "core/capture/pose_files.h"
#include "core/session/session_setup.h"
#include "core/session/session_store.h"
#include "tests/support/scan_runner.h"
#include "tests/support/synthetic_scan.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

/// A walk of 30 m through a corridor: 50 frames, five a second, 0.6 m apart.
SyntheticOptions hurriedCorridor() {
  SyntheticOptions options;
  options.recipe = synthetic::makeCorridorScene;
  options.K = {262.5F, 262.5F, 159.5F, 119.5F, 320, 240};
  options.color = false;
  options.frames = 1200;
  options.stride = 24;
  options.frames_per_second = 5;
  options.device.emplace();
  return options;
}

TEST(DevicePoses, KeepAllFramesOfACorridor) {
  const SyntheticOptions options = hurriedCorridor();
  SyntheticScan scan(options, {}, PoseUse::predicted);
  scan.run();
  ASSERT_EQ(scan.frames.size(), 50U);
  synthetic::DevicePath device(*options.device, options.seed,
                               [&](int index) { return scan.source().pose(index); });
  std::vector<PosePair> by_device;
  int alone = 0;
  for (std::size_t i = 0; i < scan.frames.size(); ++i) {
    const SyntheticScan::Frame& frame = scan.frames[i];
    EXPECT_TRUE(frame.pose.usable()) << i;
    EXPECT_FALSE(frame.pose.has_device_jumped) << i;
    alone += frame.pose.is_by_device ? 1 : 0;
    const auto time_s = static_cast<double>(i);
    const int index = static_cast<int>(i) * options.stride;
    by_device.push_back({{time_s, device.pose(index)}, {time_s, frame.true_pose}});
  }
  const double device_error_m = absoluteTrajectoryError(by_device).rmse;
  RecordProperty("ate_m", std::to_string(scan.trajectoryError()));
  RecordProperty("device_ate_m", std::to_string(device_error_m));
  RecordProperty("by_device_alone", std::to_string(alone));
  EXPECT_LT(scan.trajectoryError(), device_error_m + 0.1) << "the map adds no drift of its own";
  EXPECT_LT(alone, 25) << "the map confirms most poses";
}

ScanRequest requestOf(const std::string& source, const std::filesystem::path& folder, int frames,
                      int stride = 1, int first = 0) {
  ScanRequest request;
  request.source = source;
  request.source_options.frames = frames;
  request.source_options.stride = stride;
  request.source_options.start = first * stride;
  request.output_folder = folder;
  request.database = (folder.parent_path() / (folder.filename().string() + ".sqlite")).string();
  request.resume = first > 0;
  return request;
}

TEST(DevicePoses, AreNotTheTruthOfABenchmark) {
  const TemporaryFolder folder;
  ScanRequest automatic = requestOf("demo:tabletop:3", folder / "auto", 8, 3);
  ScanRequest tracked = requestOf("demo:tabletop:3", folder / "tracked", 8, 3);
  tracked.poses = ScanRequest::Poses::tracked;
  ASSERT_TRUE(runScan(automatic).report);
  ASSERT_TRUE(runScan(tracked).report);
  for (const char* file : {"trajectory.txt", "cloud.ply"})
    EXPECT_TRUE(readText(folder / "auto" / file) == readText(folder / "tracked" / file)) << file;
}

/// "auto", "tracked" or "given", as the session has it.
std::string storedPosesOf(const std::filesystem::path& session) {
  const QtMainThread qt;
  const auto store = SessionStore::open(session);
  EXPECT_TRUE(store) << store.error().message();
  if (!store) return {};
  const auto scan = (*store)->load();
  EXPECT_TRUE(scan) << scan.error().message();
  if (!scan) return {};
  const auto setup = setupFrom(scan->metadata);
  EXPECT_TRUE(setup) << setup.error().message();
  return setup ? setup->poses : std::string();
}

TEST(DevicePoses, HoldAcrossAResume) {
  constexpr int kStride = 20, kFirst = 6, kAll = 12;
  const TemporaryFolder folder;
  const ScanEnding first = runScan(requestOf("demo:corridor:device", folder / "scan", kFirst, kStride));
  ASSERT_TRUE(first.report) << first.error;
  EXPECT_EQ(first.report->frames.tracked, kFirst);
  const ScanEnding second =
      runScan(requestOf("demo:corridor:device", folder / "scan", kAll - kFirst, kStride, kFirst));
  ASSERT_TRUE(second.report) << second.error;
  EXPECT_EQ(second.report->frames.tracked, kAll - kFirst);
  EXPECT_EQ(storedPosesOf(folder / "scan"), "auto");

  const auto source = makeSyntheticSource("corridor", {}).value();
  const auto trajectory = readTumTrajectory(folder / "scan" / "trajectory.txt");
  ASSERT_TRUE(trajectory);
  ASSERT_EQ(trajectory->size(), static_cast<std::size_t>(kAll));
  for (int i = 0; i < kAll; ++i) {
    const Eigen::Vector3d found = (*trajectory)[static_cast<std::size_t>(i)].T_world_camera.translation();
    EXPECT_LT((found - source->pose(i * kStride).translation()).norm(), 0.03 + 0.02 * 0.5 * i)
        << i << ": in the device's world";
  }
}

TEST(DevicePoses, AreUsedAsBefore_WhenAScanIsResumed) {
  const TemporaryFolder folder;
  ScanRequest request = requestOf("demo:tabletop:device", folder / "scan", 5);
  request.poses = ScanRequest::Poses::given;
  ASSERT_TRUE(runScan(request).report);
  EXPECT_EQ(storedPosesOf(folder / "scan"), "given");
  request = requestOf("demo:tabletop:device", folder / "scan", 5, 1, 5);
  ASSERT_TRUE(runScan(request).report);
  EXPECT_EQ(storedPosesOf(folder / "scan"), "given") << "nothing was said";
  request = requestOf("demo:tabletop:device", folder / "scan", 5, 1, 10);
  request.poses = ScanRequest::Poses::tracked;
  ASSERT_TRUE(runScan(request).report);
  EXPECT_EQ(storedPosesOf(folder / "scan"), "tracked");
}

}  // namespace
}  // namespace scantrove::test
