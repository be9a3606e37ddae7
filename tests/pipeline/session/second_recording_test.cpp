// A session that resumes with another recording, whose frame numbers and times start at 0 again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "core/pipeline/mapping_pipeline.h"
#include "core/scan/open_source.h"
#include "core/session/frame_label_writer.h"
#include "core/session/open_session.h"
#include "core/session/session_store.h"
#include "tests/support/scan_runner.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

constexpr int kFirst = 8, kSecond = 6;

ScanRequest scanOf(const std::filesystem::path& folder, int frames) {
  ScanRequest request;
  request.source = "demo:tabletop:3";
  request.source_options.frames = frames;
  request.output_folder = folder;
  request.database = (folder.parent_path() / "catalogue.sqlite").string();
  request.label_maps = true;
  return request;
}

std::vector<double> timesIn(const std::filesystem::path& trajectory) {
  std::ifstream lines(trajectory);
  std::vector<double> times;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('#')) times.push_back(std::stod(line));
  }
  return times;
}

std::ptrdiff_t filesIn(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

class SecondRecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(runScan(scanOf(folder_ / "scan", kFirst)).report);
    ScanRequest second = scanOf(folder_ / "scan", kSecond);
    second.resume = true;
    ASSERT_TRUE(runScan(second).report);
  }
  TemporaryFolder folder_;
};

TEST_F(SecondRecordingTest, FramesFollowThoseOfTheFirst) {
  const std::vector<double> times = timesIn(folder_ / "scan" / "trajectory.txt");
  EXPECT_EQ(times.size(), static_cast<std::size_t>(kFirst + kSecond));
  EXPECT_EQ(std::ranges::adjacent_find(times, std::greater_equal{}), times.end())
      << testing::PrintToString(times);
  for (const char* kind : {"segments", "labels"})
    EXPECT_EQ(filesIn(folder_ / "scan" / kind), kFirst + kSecond) << kind;

  const QtMainThread qt;
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const Result<SavedScan> scan = (*store)->load();
  ASSERT_TRUE(scan);
  std::set<int> numbers;
  for (const SavedFrame& frame : scan->frames) numbers.insert(frame.source_index);
  EXPECT_EQ(numbers.size(), static_cast<std::size_t>(kFirst + kSecond));
  EXPECT_EQ(*numbers.rbegin(), kFirst + kSecond - 1);
}

// Renders the final labels from the session and compares them with the files in labels-final/.
TEST_F(SecondRecordingTest, FinalLabelsShowTheRegionsAtTheEnd) {
  const QtMainThread qt;
  const auto session = OpenSession::open(folder_ / "scan");
  ASSERT_TRUE(session) << session.error().message();
  const auto recording = openSource("demo:tabletop:3", {});
  ASSERT_TRUE(recording);
  for (int index = 0; index < kFirst; ++index) {
    const FrameRead read = (*recording)->next();
    ASSERT_EQ(read.status, FrameRead::Status::frame);
    const SavedFrame& frame = (*session)->frames().at(static_cast<std::size_t>(index));
    if (!frame.isUsable()) continue;
    MappingPipeline& pipeline = (*session)->pipeline();
    const auto view = pipeline.readout().renderView(frame.T_world_camera, pipeline.workingIntrinsics());
    ASSERT_TRUE(view);
    const auto file = folder_ / "scan" / "labels-final" / labelFileName(index);
    RegionNumbers numbers;
    const auto expected =
        FrameLabelWriter::drawFinal(file, *view, read.frame.depth, read.frame.meters_per_unit, numbers);
    ASSERT_TRUE(expected);
    EXPECT_TRUE(readText(file) == *expected) << index;
  }
}

TEST_F(SecondRecordingTest, SessionStoresTheShiftOfFrameNumbersAndTimes) {
  const QtMainThread qt;
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const Result<SavedScan> scan = (*store)->load();
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->recordings.size(), 2U);
  EXPECT_EQ(scan->recordings[0].index_shift, 0);
  EXPECT_EQ(scan->recordings[1].source, "demo:tabletop:3");
  EXPECT_EQ(scan->recordings[1].first_frame, kFirst);
  EXPECT_EQ(scan->recordings[1].index_shift, kFirst);
  const SavedFrame& first = scan->frames.at(kFirst);
  EXPECT_EQ(first.source_index - scan->recordings[1].index_shift, 0);
  EXPECT_NEAR(first.time_s - scan->recordings[1].time_shift_s, 0, 1e-9);
}

}  // namespace
}  // namespace scantrove::test
