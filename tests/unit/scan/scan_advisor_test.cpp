#include "core/scan/scan_advisor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scantrove::test {
namespace {

using testing::HasSubstr;

constexpr float kMaxDepth_m = 5;

RgbdFrame frameAt(double depth_m) {
  RgbdFrame frame;
  frame.depth = cv::Mat(48, 64, CV_16UC1, cv::Scalar(depth_m * 1000));
  return frame;
}

std::optional<Error> addFrames(ScanAdvisor& advisor, int count, bool is_usable, double depth_m = 2) {
  std::optional<Error> advice;
  for (int i = 0; i < count; ++i) {
    if (const auto now = advisor.addFrame(frameAt(depth_m), is_usable)) advice = now;
  }
  return advice;
}

TEST(ScanAdvisor, IsMisled_WhenTheCameraIsLostAfterTheFirstFrame) {
  ScanAdvisor advisor(kMaxDepth_m);
  addFrames(advisor, 1, true);
  addFrames(advisor, ScanAdvisor::kLostFrames - 1, false);
  EXPECT_FALSE(advisor.isMisled());
  addFrames(advisor, 1, false);
  EXPECT_TRUE(advisor.isMisled());
  EXPECT_THAT(advisor.restart(30).message(), HasSubstr("after the first frame and not found again"));
  EXPECT_FALSE(advisor.isMisled());
  addFrames(advisor, ScanAdvisor::kLostFrames, false);
  EXPECT_FALSE(advisor.isMisled()) << "there is no map yet";
}

TEST(ScanAdvisor, IsNotMisled_WhenTheMapIsOlder) {
  ScanAdvisor advisor(kMaxDepth_m);
  addFrames(advisor, ScanAdvisor::kYoungMapFrames + 1, true);
  addFrames(advisor, 10 * ScanAdvisor::kLostFrames, false);
  EXPECT_FALSE(advisor.isMisled());
}

TEST(ScanAdvisor, IsNotMisled_WhenTheCameraIsFoundAgain) {
  ScanAdvisor advisor(kMaxDepth_m);
  for (int i = 0; i < 3; ++i) {
    addFrames(advisor, 1, true);
    addFrames(advisor, ScanAdvisor::kLostFrames - 1, false);
  }
  EXPECT_FALSE(advisor.isMisled());
}

TEST(ScanAdvisor, WarnsOnce_WhenMostDepthIsTooFar) {
  ScanAdvisor advisor(kMaxDepth_m);
  const auto advice = addFrames(advisor, 20, true, 7);
  ASSERT_TRUE(advice);
  EXPECT_THAT(advice->message(), HasSubstr("100 % is farther away than 5 m"));
  EXPECT_FALSE(addFrames(advisor, 100, true, 7));
}

TEST(ScanAdvisor, DoesNotWarn_WhenMostFramesAreNear) {
  ScanAdvisor advisor(kMaxDepth_m);
  EXPECT_FALSE(addFrames(advisor, 8, true, 7));
  EXPECT_FALSE(addFrames(advisor, 40, true, 2));
}

TEST(ScanAdvisor, AdvisesAtTheEnd_WhenMostFramesAreLost) {
  FrameCounts frames{.read = 90, .tracked = 10, .lost = 80};
  const auto advice = ScanAdvisor::adviceOn(frames);
  ASSERT_TRUE(advice);
  EXPECT_THAT(advice->message(), HasSubstr("Of 90 frames only 10 are in the map"));
  frames = {.read = 90, .tracked = 60, .lost = 30};
  EXPECT_FALSE(ScanAdvisor::adviceOn(frames));
}

TEST(ScanAdvisor, AdvisesAtTheEnd_WhenMostPosesAreTheDevicesAlone) {
  const auto advice = ScanAdvisor::adviceOn({.read = 90, .tracked = 90, .by_device = 70});
  ASSERT_TRUE(advice);
  EXPECT_THAT(advice->message(), HasSubstr("Of 90 frames in the map 70 follow the device's own poses alone"));
  EXPECT_FALSE(ScanAdvisor::adviceOn({.read = 90, .tracked = 90, .by_device = 20}));
}

}  // namespace
}  // namespace scantrove::test
