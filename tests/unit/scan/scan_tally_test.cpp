#include "core/scan/scan_tally.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

FrameResult lost() { return {}; }

FrameResult tracked() {
  FrameResult result;
  result.pose.state = TrackingState::tracking;
  return result;
}

FrameResult returnedAfterDrift(double drift_m) {
  FrameResult result = tracked();
  result.returned.emplace();
  result.returned->drift_m = drift_m;
  return result;
}

class ScanTallyTest : public testing::Test {
 protected:
  [[nodiscard]] ScanReport report() const {
    ScanReport report;
    tally_.fill(report);
    return report;
  }
  ScanTally tally_{FrameCounts{}};
};

TEST_F(ScanTallyTest, CountsALateFrameAsTracked_WhenItWasLostBefore) {
  static_cast<void>(tally_.addFrame(tracked(), 0));
  static_cast<void>(tally_.addFrame(lost(), 1));
  static_cast<void>(tally_.addFrame(lost(), 2));
  FrameResult result = tracked();
  result.late = {{1, 0.1, tracked().pose}};
  static_cast<void>(tally_.addFrame(result, 3));
  EXPECT_EQ(tally_.frames().read, 4);
  EXPECT_EQ(tally_.frames().tracked, 3);
  EXPECT_EQ(tally_.frames().lost, 1);
  EXPECT_THAT(report().lost_frames, ElementsAre(2));
}

TEST_F(ScanTallyTest, CountsFramesByTheDeviceAlone_AndItsJumps) {
  FrameResult by_device = tracked();
  by_device.pose.is_by_device = true;
  FrameResult jumped = tracked();
  jumped.pose.has_device_jumped = true;
  int index = 0;
  for (const FrameResult& result : {tracked(), by_device, jumped, by_device})
    static_cast<void>(tally_.addFrame(result, index++));
  EXPECT_EQ(report().frames.tracked, 4);
  EXPECT_EQ(report().frames.by_device, 2);
  EXPECT_EQ(report().drift.device_jumps, 1);
}

TEST_F(ScanTallyTest, CountsTrackedFramesAsLost_WhenTheMapIsDiscarded) {
  static_cast<void>(tally_.addFrame(tracked(), 4));
  static_cast<void>(tally_.addFrame(lost(), 3));
  tally_.restart();
  static_cast<void>(tally_.addFrame(tracked(), 5));
  EXPECT_EQ(tally_.frames().tracked, 1);
  EXPECT_EQ(tally_.frames().lost, 2);
  EXPECT_THAT(report().lost_frames, ElementsAre(3, 4));
}

TEST_F(ScanTallyTest, WarnsOfDriftOnce_UntilItGrowsClearly) {
  EXPECT_FALSE(tally_.addFrame(returnedAfterDrift(0.05), 1)) << "within the accuracy of landmarks";
  const std::optional<Error> first = tally_.addFrame(returnedAfterDrift(0.12), 2);
  ASSERT_TRUE(first);
  EXPECT_THAT(first->message(), HasSubstr("12 cm"));
  EXPECT_FALSE(tally_.addFrame(returnedAfterDrift(0.14), 3));
  EXPECT_TRUE(tally_.addFrame(returnedAfterDrift(0.30), 4));
  EXPECT_EQ(report().drift.revisited_key_frames, 4);
  EXPECT_DOUBLE_EQ(report().drift.most_m, 0.30);
}

TEST_F(ScanTallyTest, KeepsTheCountsOfASession_WhenNoFrameIsAdded) {
  const ScanTally of_session(FrameCounts{.read = 9, .tracked = 7, .lost = 2});
  ScanReport report;
  of_session.fill(report);
  EXPECT_EQ(report.frames.tracked, 7);
  EXPECT_THAT(report.lost_frames, IsEmpty());
  EXPECT_EQ(report.fps, 0);
}

}  // namespace
}  // namespace scantrove
