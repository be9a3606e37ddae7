#include "core/base/stage_timer.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace scantrove {
namespace {

TEST(Summarize, ReturnsTheNearestRank) {
  EXPECT_EQ(summarize({}).median_ms, 0);
  EXPECT_EQ(summarize({7}).median_ms, 7);
  EXPECT_EQ(summarize({7}).p95_ms, 7);
  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i) hundred.push_back(i);
  EXPECT_EQ(summarize(hundred).median_ms, 50);
  EXPECT_EQ(summarize(hundred).p95_ms, 95);
}

TEST(StageTimer, KeepsCallOrderAndSumsTimesOfAFrame) {
  StageTimer timer;
  timer.add("track", 3);
  timer.add("fuse", 5);
  timer.add("track", 4);
  timer.endFrame();
  timer.add("fuse", 1);
  timer.endFrame();
  ASSERT_EQ(timer.stages().size(), 2U);
  EXPECT_EQ(timer.stages()[0].name, "track");
  EXPECT_EQ(timer.stages()[0].all_ms, std::vector<double>{7});
  EXPECT_EQ(timer.stages()[1].all_ms, (std::vector<double>{5, 1}));
  EXPECT_EQ(timer.stages()[1].last_ms, 1);
}

TEST(StageTimer, KeepsEvenlySpacedFrames_WhenTheScanIsLong) {
  StageTimer timer;
  constexpr std::size_t kFrames = 5 * StageTimer::kMaxFrames + 3;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    timer.add("fuse", static_cast<double>(frame));
    if (frame % 10 == 5) timer.add("keep", 1);
    timer.endFrame();
  }
  const StageTimer::Stage& fuse = timer.stages()[0];
  const StageTimer::Stage& keep = timer.stages()[1];
  EXPECT_EQ(fuse.last_ms, kFrames - 1.0);
  EXPECT_EQ(fuse.runs, kFrames);
  EXPECT_EQ(fuse.every, 8U);
  ASSERT_EQ(fuse.all_ms.size(), (kFrames + 7) / 8) << "every eighth from the first on";
  ASSERT_EQ(fuse.frames.size(), fuse.all_ms.size());
  for (std::size_t i = 0; i < fuse.frames.size(); ++i) {
    EXPECT_EQ(fuse.frames[i], 8 * i);
    EXPECT_EQ(fuse.all_ms[i], 8.0 * static_cast<double>(i));
  }
  EXPECT_NEAR(summarize(fuse.all_ms).p95_ms, 0.95 * kFrames, 8);
  EXPECT_EQ(keep.all_ms.size(), kFrames / 10) << "a rare stage keeps all its times";
}

TEST(SlowestFrames, NameTheStageFarthestAboveItsMedian) {
  StageTimer timer;
  for (int frame = 0; frame < 9; ++frame) {
    timer.add("fuse", frame == 4 ? 12 : 10);
    if (frame != 2) timer.add("track", frame == 4 ? 9 : frame == 7 ? 4 : 3);  // tracking is lost in frame 2
    timer.endFrame();
  }
  const std::vector<SlowFrame> slowest = slowestFrames(timer.stages(), 2);
  ASSERT_EQ(slowest.size(), 2U);
  EXPECT_EQ(slowest[0].frame, 4U);
  EXPECT_EQ(slowest[0].total_ms, 21);
  EXPECT_EQ(slowest[0].stage, "track");
  EXPECT_EQ(slowest[0].stage_ms, 9);
  EXPECT_EQ(slowest[1].frame, 7U);
  EXPECT_EQ(slowestFrames(timer.stages(), 100).size(), 9U);
  EXPECT_EQ(slowestFrames(timer.stages(), 100).back().frame, 2U);
  EXPECT_TRUE(slowestFrames({}, 3).empty());
}

TEST(StageTimer, ReturnsTheResultOfTheWork) {
  StageTimer timer;
  EXPECT_EQ(timer.time("add", [] { return 1 + 2; }), 3);
  timer.time("nothing", [] {});
  timer.endFrame();
  EXPECT_EQ(timer.stages().size(), 2U);
}

TEST(StageTimer, CountsWorkThatThrows) {
  StageTimer timer;
  EXPECT_THROW(timer.time("fault", [] { throw std::runtime_error("device lost"); }), std::runtime_error);
  timer.endFrame();
  EXPECT_EQ(timer.stages().at(0).all_ms.size(), 1U);
}

TEST(StageTimer, MeasuresWallTime) {
  StageTimer timer;
  timer.time("sleep", [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); });
  timer.endFrame();
  EXPECT_GE(timer.stages().at(0).last_ms, 5);
}

}  // namespace
}  // namespace scantrove
