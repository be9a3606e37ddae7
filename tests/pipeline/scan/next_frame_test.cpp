#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "core/pipeline/mapping_pipeline.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {
namespace {

/// Frames with all kinds of poses: tracked, lens covered, found again, after a jump.
std::vector<RgbdFrame> recordedFrames() {
  const auto source = makeSyntheticSource("room:7", {}).value();
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < 34; ++i) {
    RgbdFrame frame = source->next().frame;
    if (i > 10 && i < 14) frame.depth = cv::Mat::zeros(frame.depth.size(), frame.depth.type());
    if (i < 20 || i > 26) frames.push_back(std::move(frame));
  }
  return frames;
}

struct Outcome {
  std::vector<FrameResult> results;
  int requests = 0;  ///< frames for which the next one was requested
};

/// `ahead`: the frame that is announced while frame i is processed.
template <class Ahead>
Outcome scan(ComputeContext& compute, const std::vector<RgbdFrame>& frames, Ahead&& ahead,
             const Intrinsics& K = SyntheticOptions{}.K) {
  const auto pipeline = MappingPipeline::create(compute, {K, MappingParams{}}).value();
  Outcome outcome;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Result<FrameResult> result = pipeline->processFrame(frames[i], [&]() -> std::optional<RgbdFrame> {
      ++outcome.requests;
      return ahead(i);
    });
    EXPECT_TRUE(result) << result.error().message();
    outcome.results.push_back(std::move(*result));
  }
  return outcome;
}

void expectSameResults(const Outcome& a, const Outcome& b) {
  ASSERT_EQ(a.results.size(), b.results.size());
  for (std::size_t i = 0; i < a.results.size(); ++i) {
    const FrameResult& first = a.results[i];
    const FrameResult& second = b.results[i];
    ASSERT_EQ(first.pose.state, second.pose.state) << i;
    ASSERT_EQ(first.pose.T_world_camera.matrix(), second.pose.T_world_camera.matrix()) << i;
    ASSERT_EQ(first.view.vertices_world, second.view.vertices_world) << i;
    ASSERT_EQ(first.view.regions, second.view.regions) << i;
    ASSERT_EQ(first.late.size(), second.late.size()) << i;
    ASSERT_EQ(first.is_tracking_key_frame, second.is_tracking_key_frame) << i;
  }
}

TEST(NextFrame, GivesTheSameResults_WhenStartedEarly) {
  const auto compute = ComputeContext::create({}).value();
  const std::vector<RgbdFrame> frames = recordedFrames();
  const Outcome in_turn = scan(*compute, frames, [](std::size_t) { return std::nullopt; });
  const Outcome ahead = scan(*compute, frames, [&](std::size_t i) {
    return i + 1 < frames.size() ? std::optional(frames[i + 1]) : std::nullopt;
  });
  // A frame without a pose has no labelling, so nothing runs beside it.
  EXPECT_EQ(in_turn.results[12].pose.usable(), false);
  EXPECT_GT(ahead.requests, 20);
  expectSameResults(in_turn, ahead);
}

TEST(NextFrame, GivesTheSameResults_WhenFramesHaveOwnCamerasAndFewColors) {
  const auto compute = ComputeContext::create({}).value();
  SourceOptions options;
  options.frames = 24;
  const auto source = makeSyntheticSource("room:phone", options).value();
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < 24; ++i) frames.push_back(source->next().frame);
  frames[11].intrinsics.reset();  // has that of the recording
  const Intrinsics K = source->info().intrinsics;
  const Outcome in_turn = scan(
      *compute, frames, [](std::size_t) { return std::nullopt; }, K);
  const Outcome ahead = scan(
      *compute, frames,
      [&](std::size_t i) { return i + 1 < frames.size() ? std::optional(frames[i + 1]) : std::nullopt; }, K);
  EXPECT_GT(ahead.requests, 10);
  expectSameResults(in_turn, ahead);
}

// The closest real case: a camera that is unplugged and plugged in again.
TEST(NextFrame, IsProcessedAgain_WhenAnotherWasAnnounced) {
  const auto compute = ComputeContext::create({}).value();
  const std::vector<RgbdFrame> frames = recordedFrames();
  const Outcome in_turn = scan(*compute, frames, [](std::size_t) { return std::nullopt; });
  const Outcome wrong = scan(*compute, frames, [&](std::size_t i) {
    return std::optional(frames[i % 3 == 0 ? 0 : std::min(i + 1, frames.size() - 1)]);
  });
  expectSameResults(in_turn, wrong);
}

}  // namespace
}  // namespace scantrove::test
