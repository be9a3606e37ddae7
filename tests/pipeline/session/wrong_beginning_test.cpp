// Recordings whose first frame shows another scene than the rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "core/scan/scan_advisor.h"
#include "core/session/session_store.h"
#include "tests/support/scan_runner.h"
#include "tests/support/synthetic_recording.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr int kRecordedFrames = 42, kLost = 1 + ScanAdvisor::kLostFrames;

/// Replaces a frame of the table by a ball close to the camera.
void showBall(RgbdFrame& frame) {
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const double x = (u - frame.depth.cols / 2) / 130.0, y = (v - frame.depth.rows / 2) / 130.0;
      frame.depth.at<std::uint16_t>(v, u) =
          static_cast<std::uint16_t>(900 - 350 * std::sqrt(std::max(0.0, 1 - x * x - y * y)));
    }
  }
  frame.color.setTo(cv::Scalar(40, 90, 160));
}

class WrongFirstFrameTest : public testing::Test {
 protected:
  void SetUp() override {
    writeRecording(folder_ / "rec", smallRecording(), kRecordedFrames, [](RgbdFrame& frame) {
      if (frame.index == 0) showBall(frame);
      // Poses must come from tracking.
      frame.T_world_camera.reset();
    });
    ScanRequest request;
    request.source = (folder_ / "rec").string();
    request.output_folder = folder_ / "scan";
    request.database = (folder_ / "catalogue.sqlite").string();
    request.label_maps = true;
    ending_ = runScan(request);
    ASSERT_TRUE(ending_.report) << ending_.error;
  }
  TemporaryFolder folder_;
  ScanEnding ending_;
};

TEST_F(WrongFirstFrameTest, MapStartsAgain_AfterASecond) {
  const ScanReport& report = *ending_.report;
  EXPECT_EQ(report.frames.lost, kLost);
  EXPECT_EQ(report.frames.tracked, kRecordedFrames - kLost);
  EXPECT_EQ(report.lost_frames.size(), static_cast<std::size_t>(kLost));
  EXPECT_TRUE(std::ranges::is_sorted(report.lost_frames));
  EXPECT_THAT(report.advice, Contains(HasSubstr("the map begins anew after frame 30")));
  EXPECT_THAT(report.advice, Contains(HasSubstr("Of 42 frames only 11 are in the map")));
  EXPECT_GT(report.regions, 0);
}

TEST_F(WrongFirstFrameTest, NothingOfTheFirstMapIsStored) {
  const auto images = std::distance(std::filesystem::directory_iterator(folder_ / "scan" / "labels"), {});
  EXPECT_EQ(images, kRecordedFrames - kLost);
  const QtMainThread qt;
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const Result<SavedScan> scan = (*store)->load();
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->frames.size(), static_cast<std::size_t>(kRecordedFrames));
  EXPECT_EQ(std::ranges::count_if(scan->frames, &SavedFrame::isUsable), kRecordedFrames - kLost);
  EXPECT_FALSE(scan->frames.front().isUsable());
  for (const SavedKeyFrame& key : scan->key_frames) EXPECT_GE(key.frame, kLost);
  for (const auto& file : std::filesystem::directory_iterator(folder_ / "scan" / "keyframes"))
    EXPECT_GE(std::stoi(file.path().filename().string()), kLost) << file.path();
}

}  // namespace
}  // namespace scantrove::test
