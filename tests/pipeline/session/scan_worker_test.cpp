#include "core/scan/scan_worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <set>
#include <tuple>

#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using test::ScanWorkerTest;

TEST_F(ScanWorkerTest, RunsARecordingToItsEnd) {
  worker_.post(StartScan{request(4)});
  worker_.wait();
  EXPECT_THAT(log_.states(), ElementsAre(ScanState::starting, ScanState::scanning, ScanState::finishing,
                                         ScanState::finished));
  EXPECT_EQ(worker_.state(), ScanState::finished);
}

#ifdef __linux__
TEST_F(ScanWorkerTest, LowersItsPriority_WithAWindow) {
  std::atomic<int> niceness = 0;
  ScanWorker worker(
      [&](const ScanEvent&) { niceness = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); },
      Niceness::scan_beside_window);
  worker.post(StartScan{request(1)});
  worker.wait();
  EXPECT_GE(niceness, static_cast<int>(Niceness::scan_beside_window));
}
#endif

TEST_F(ScanWorkerTest, StepProcessesOneFrame) {
  ScanRequest paused = request(10);
  paused.start_paused = true;
  worker_.post(StartScan{std::move(paused)});
  log_.awaitState(ScanState::paused);
  for (int step = 1; step <= 3; ++step) {
    worker_.post(StepScan{});
    const auto snapshot = awaitSnapshot(step);
    ASSERT_TRUE(snapshot);
    EXPECT_EQ(snapshot->frames.done(), step);
    EXPECT_EQ(snapshot->state, ScanState::paused);
    EXPECT_EQ(snapshot->frames_total, 10);
  }
  worker_.post(ResumeScan{});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished);
}

TEST_F(ScanWorkerTest, StopEndsAScan_WithItsResults) {
  ScanRequest long_scan = request(150);
  long_scan.output_folder = folder_ / "out";
  worker_.post(StartScan{std::move(long_scan)});
  ASSERT_TRUE(awaitSnapshot(2));
  worker_.post(StopScan{});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "report.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "cloud.ply"));
}

// Parameters tried in a pause change the shown segments, but not the scan.
TEST_F(ScanWorkerTest, PausedFrameIsSegmentedAgain_WhenParametersChange) {
  const auto segmentsIn = [](const ScanSnapshot& snapshot) {
    double most = 0;
    cv::minMaxLoc(snapshot.segments, nullptr, &most);
    return static_cast<int>(most);
  };
  const auto isSame = [](const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
  };
  ScanRequest tried = request(6);
  tried.start_paused = true;
  tried.output_folder = folder_ / "tried";
  worker_.post(StartScan{tried});
  log_.awaitState(ScanState::paused);
  std::shared_ptr<const ScanSnapshot> before;
  for (int step = 1; step <= 3; ++step) {
    worker_.post(StepScan{});
    before = awaitSnapshot(step);
    ASSERT_TRUE(before);
  }
  ScanParams params = tried.params;
  for (const float k : {params.segmentation.k / 20, params.segmentation.k * 20}) {
    ScanParams other = params;
    other.segmentation.k = k;
    worker_.post(SetParams{other});
    const auto after = awaitSnapshot(3);
    ASSERT_TRUE(after);
    if (k < params.segmentation.k) {
      EXPECT_GT(segmentsIn(*after), segmentsIn(*before));
    } else {
      EXPECT_LT(segmentsIn(*after), segmentsIn(*before));
    }
    EXPECT_EQ(after->state, ScanState::paused);
    EXPECT_EQ(after->frames.done(), 3);
    EXPECT_TRUE(isSame(after->regions, before->regions));
    EXPECT_TRUE(isSame(after->depth_fused_m, before->depth_fused_m));
    EXPECT_EQ(after->map_bricks, before->map_bricks);
    EXPECT_TRUE(after->changed_bricks.empty());
    EXPECT_TRUE(after->changed_regions.empty());
  }
  worker_.post(SetParams{params});
  const auto back = awaitSnapshot(3);
  ASSERT_TRUE(back);
  EXPECT_TRUE(isSame(back->segments, before->segments));
  worker_.post(ResumeScan{});
  worker_.wait();

  ScanRequest plain = request(6);
  plain.database = (folder_ / "other.sqlite").string();
  plain.output_folder = folder_ / "plain";
  worker_.post(StartScan{plain});
  worker_.wait();
  const auto bytesOf = [&](const char* scan) {
    std::ifstream file(folder_ / scan / "cloud.ply", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string cloud = bytesOf("plain");
  ASSERT_GT(cloud.size(), 10'000U);
  EXPECT_TRUE(bytesOf("tried") == cloud) << "the tried parameters changed the scan";
}

TEST_F(ScanWorkerTest, PauseStopsFrames_AndResumeContinues) {
  worker_.post(StartScan{request(60)});
  ASSERT_TRUE(awaitSnapshot(1));
  worker_.post(PauseScan{});
  log_.awaitState(ScanState::paused);
  const auto paused = awaitSnapshot(1);
  ASSERT_TRUE(paused);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(worker_.snapshots().collect()) << "a paused scan continued";
  worker_.post(ResumeScan{});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished);
}

TEST_F(ScanWorkerTest, FailedStartIsReported_AndTheNextOneWorks) {
  ScanRequest wrong = request(3);
  wrong.source = "/no/such/recording";
  worker_.post(StartScan{std::move(wrong)});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("/no/such/recording"));
  worker_.post(StartScan{request(2)});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished);
}

TEST_F(ScanWorkerTest, NewStartEndsThePreviousScan) {
  worker_.post(StartScan{request(150)});
  ASSERT_TRUE(awaitSnapshot(1));
  worker_.post(StartScan{request(2)});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::finished);
  const std::vector<ScanState> states = log_.states();
  EXPECT_EQ(std::count(states.begin(), states.end(), ScanState::starting), 2);
}

TEST_F(ScanWorkerTest, RefusesEditsAndExports_WithoutAScan) {
  worker_.post(EditRegions{UndoEdit{}});
  ASSERT_NO_FATAL_FAILURE(log_.await<EditFailed>());
  worker_.post(PreviewExport{});
  worker_.post(SampleExport{});
  worker_.post(ExportDataset{});
  ASSERT_NO_FATAL_FAILURE(log_.await<ExportFailed>(3));
  EXPECT_EQ(worker_.state(), ScanState::idle);
}

TEST_F(ScanWorkerTest, ProcessesAllEdits_BeforeItCloses) {
  ScanRequest paused = request(40);
  paused.start_paused = true;
  worker_.post(StartScan{std::move(paused)});
  worker_.post(StepScan{});
  ASSERT_TRUE(awaitSnapshot(1));
  for (int i = 0; i < 3; ++i) worker_.post(EditRegions{UndoEdit{}});
  worker_.post(CloseScan{});
  worker_.wait();
  EXPECT_EQ(log_.all<EditFailed>().size(), 3U) << "there is nothing to undo";
  EXPECT_EQ(log_.states(),
            (std::vector{ScanState::starting, ScanState::paused, ScanState::finishing, ScanState::finished}));
}

TEST_F(ScanWorkerTest, RefusesGivenPoses_WhenTheSourceHasNone) {
  ScanRequest given = request(3);
  given.source = "camera:Dummy";
  given.poses = ScanRequest::Poses::given;
  worker_.post(StartScan{std::move(given)});
  worker_.wait();
  EXPECT_EQ(worker_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("has no poses"));
}

TEST_F(ScanWorkerTest, SnapshotsHaveColorsNormalsAndHeights) {
  worker_.post(StartScan{request(20)});
  worker_.wait();
  const auto last = worker_.snapshots().collect();
  ASSERT_TRUE(last);
  std::size_t points = 0, with_normal = 0, with_color = 0;
  std::set<std::array<std::uint8_t, 3>> colors;
  for (const CloudBrick& brick : last->changed_bricks) {
    for (const CloudBrick::Point& point : brick.points) {
      ++points;
      with_normal += point.normal.known() ? 1U : 0U;
      with_color += point.color.known() ? 1U : 0U;
      colors.insert(point.color.rgb);
      ASSERT_LE(std::abs(point.height), 60);
    }
  }
  ASSERT_GT(points, 10'000U);
  EXPECT_GT(static_cast<double>(with_normal), 0.95 * static_cast<double>(points));
  // ColorIntegrator colours bricks in turn, so some have no colour yet.
  EXPECT_GT(static_cast<double>(with_color), 0.4 * static_cast<double>(points));
  EXPECT_GT(colors.size(), 500U);
}

// A slow window skips snapshots; their bricks come with the next one.
TEST_F(ScanWorkerTest, ChangedBricksOfUncollectedSnapshotsAreNotLost) {
  worker_.post(StartScan{request(6)});
  worker_.wait();
  const auto last = worker_.snapshots().collect();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->state, ScanState::finished);
  EXPECT_EQ(last->frames.done(), 6);
  std::set<FragmentId> with_region;
  for (const RegionChange& change : last->changed_regions) with_region.insert(change.fragment);
  std::set<std::tuple<int, int, int>> bricks;
  std::size_t points = 0;
  for (const CloudBrick& brick : last->changed_bricks) {
    bricks.insert({brick.position.x(), brick.position.y(), brick.position.z()});
    points += brick.points.size();
    for (const CloudBrick::Point& point : brick.points) ASSERT_TRUE(with_region.contains(point.fragment));
  }
  EXPECT_GT(points, 10000U);

  // The same scan sends the same bricks when all snapshots are collected.
  std::set<std::tuple<int, int, int>> bricks_again;
  ScanWorker other([](const ScanEvent&) {});
  other.post(StartScan{request(6)});
  while (other.state() != ScanState::finished || !other.snapshots().empty()) {
    const auto snapshot = other.snapshots().collect();
    if (!snapshot) continue;
    for (const CloudBrick& brick : snapshot->changed_bricks) {
      bricks_again.insert({brick.position.x(), brick.position.y(), brick.position.z()});
    }
  }
  EXPECT_EQ(bricks_again, bricks);
}

}  // namespace
}  // namespace scantrove
