#include <gtest/gtest.h>

#include "core/session/session_restorer.h"

namespace scantrove::test {
namespace {

SavedScan threeFrames() {
  SavedScan scan;
  for (int number = 0; number < 3; ++number) {
    SavedFrame frame;
    frame.number = frame.source_index = number;
    frame.state = number == 1 ? TrackingState::lost : TrackingState::tracking;
    if (frame.isUsable()) frame.T_world_camera.translation().x() = 1;
    scan.frames.push_back(frame);
  }
  return scan;
}

TEST(LostMap, LosesTheFrames_WhenNoMapWasStored) {
  SavedScan scan = threeFrames();
  EXPECT_EQ(loseFramesWithoutMap(scan), 2);
  ASSERT_EQ(scan.frames.size(), 3U);
  for (const SavedFrame& frame : scan.frames) {
    EXPECT_FALSE(frame.isUsable());
    EXPECT_TRUE(frame.T_world_camera.matrix().isIdentity());
  }
  EXPECT_EQ(scan.frames[2].source_index, 2) << "a continued recording goes on behind it";
}

TEST(LostMap, KeepsTheFrames_WhenTheirMapWasStored) {
  SavedScan scan = threeFrames();
  scan.pages.emplace_back(0, 0, 0);
  EXPECT_EQ(loseFramesWithoutMap(scan), 0);
  EXPECT_TRUE(scan.frames[2].isUsable());
}

TEST(LostMap, KeepsTheFrames_WhenRegionsShowThatAMapWasThere) {
  SavedScan scan = threeFrames();
  scan.fragments.emplace_back();
  EXPECT_EQ(loseFramesWithoutMap(scan), 0);
  EXPECT_TRUE(scan.frames[2].isUsable());
}

}  // namespace
}  // namespace scantrove::test
