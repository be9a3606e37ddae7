#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "core/pipeline/mapping_pipeline.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {
namespace {

/// A camera that is followed, has its lens covered, comes back, and jumps: poses of every kind.
std::vector<RgbdFrame> film() {
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
  int told = 0;  ///< frames whose next one was asked for
};

/// `ahead`: the frame that is announced while number i is in work.
template <class Ahead>
Outcome scan(ComputeContext& compute, const std::vector<RgbdFrame>& frames, Ahead&& ahead) {
  const Intrinsics K = SyntheticOptions{}.K;
  const auto pipeline = MappingPipeline::create(compute, {K, MappingParams{}}).value();
  Outcome outcome;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Result<FrameResult> result = pipeline->processFrame(frames[i], [&]() -> std::optional<RgbdFrame> {
      ++outcome.told;
      return ahead(i);
    });
    EXPECT_TRUE(result) << result.error().message();
    outcome.results.push_back(std::move(*result));
  }
  return outcome;
}

void expectTheSame(const Outcome& a, const Outcome& b) {
  ASSERT_EQ(a.results.size(), b.results.size());
  for (std::size_t i = 0; i < a.results.size(); ++i) {
    const FrameResult& left = a.results[i];
    const FrameResult& right = b.results[i];
    ASSERT_EQ(left.pose.state, right.pose.state) << i;
    ASSERT_EQ(left.pose.T_world_camera.matrix(), right.pose.T_world_camera.matrix()) << i;
    ASSERT_EQ(left.view.vertices_world, right.view.vertices_world) << i;
    ASSERT_EQ(left.view.regions, right.view.regions) << i;
    ASSERT_EQ(left.late.size(), right.late.size()) << i;
    ASSERT_EQ(left.is_tracking_key_frame, right.is_tracking_key_frame) << i;
  }
}

TEST(NextFrame, BegunBeforeItsTurnGivesTheSameResults) {
  const auto compute = ComputeContext::create({}).value();
  const std::vector<RgbdFrame> frames = film();
  const Outcome in_turn = scan(*compute, frames, [](std::size_t) { return std::nullopt; });
  const Outcome ahead = scan(*compute, frames, [&](std::size_t i) {
    return i + 1 < frames.size() ? std::optional(frames[i + 1]) : std::nullopt;
  });
  // Without a pose there is no labelling that anything could run beside.
  EXPECT_EQ(in_turn.results[12].pose.usable(), false);
  EXPECT_GT(ahead.told, 20);
  expectTheSame(in_turn, ahead);
}

// Nobody does that; a camera that is unplugged and plugged in again comes close.
TEST(NextFrame, AnotherThanWasAnnouncedIsLookedAtAnew) {
  const auto compute = ComputeContext::create({}).value();
  const std::vector<RgbdFrame> frames = film();
  const Outcome in_turn = scan(*compute, frames, [](std::size_t) { return std::nullopt; });
  const Outcome wrong = scan(*compute, frames, [&](std::size_t i) {
    return std::optional(frames[i % 3 == 0 ? 0 : std::min(i + 1, frames.size() - 1)]);
  });
  expectTheSame(in_turn, wrong);
}

}  // namespace
}  // namespace scantrove::test
