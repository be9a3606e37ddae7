#include "core/capture/looped_source.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {
namespace {

Result<std::unique_ptr<FrameSource>> threeFrames() {
  SyntheticOptions options;
  options.K = {52.5F, 52.5F, 31.5F, 23.5F, 64, 48};
  options.frames = 3;
  options.noise = false;
  auto source = makeSyntheticSource(options);
  if (!source) return fail(source.error());
  return std::move(*source);
}

TEST(LoopedSource, RepeatsTheRecording_WithNumbersThatGoOn) {
  LoopedSource source(std::move(*threeFrames()), threeFrames, 3);
  EXPECT_EQ(source.info().frame_count, 9);
  double last_time_s = -1;
  for (int i = 0; i < 9; ++i) {
    const FrameRead read = source.next();
    ASSERT_EQ(read.status, FrameRead::Status::frame) << i;
    EXPECT_EQ(read.frame.index, i);
    EXPECT_GT(read.frame.timestamp_s, last_time_s);
    EXPECT_EQ(read.is_reconnected, i == 3 || i == 6) << i;
    last_time_s = read.frame.timestamp_s;
  }
  EXPECT_EQ(source.next().status, FrameRead::Status::end);
}

TEST(LoopedSource, Fails_WhenTheRecordingCannotBeOpenedAgain) {
  const auto gone = []() -> Result<std::unique_ptr<FrameSource>> { return fail("The disk is gone."); };
  LoopedSource source(std::move(*threeFrames()), gone, 2);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(source.next().status, FrameRead::Status::frame);
  const FrameRead last = source.next();
  EXPECT_EQ(last.status, FrameRead::Status::failed);
  EXPECT_EQ(last.error.what, "The disk is gone.");
}

}  // namespace
}  // namespace scantrove::test
