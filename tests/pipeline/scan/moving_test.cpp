#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/scan/scan_pipeline.h"
#include "core/synthetic/film_set.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/support/true_surface.h"

namespace scantrove::test {
namespace {

SyntheticOptions moving(bool noise) {
  SyntheticOptions options;
  options.set = [] { return synthetic::makeRandomMovingSet(2); };
  options.noise = noise;
  options.color = noise;
  return options;
}

// Mug and chair are at rest from then on.
constexpr int kAllIsDone = 335;

TrueSurface whatIsThereAtTheEnd() {
  SyntheticOptions options = moving(false);
  options.stride = 15;
  const auto source = makeSyntheticSource(options).value();
  const auto id = [&](const char* name) { return source->scene().find(name); };
  TrueSurface surface;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const bool is_done = read.frame.index >= kAllIsDone;
    surface.add(read.frame, options.K, [&](std::uint16_t who) {
      return who != id("walker") && who != id("arm") && (is_done || (who != id("mug") && who != id("chair")));
    });
  }
  return surface;
}

TEST(MovingScene, LeavesNoGhostsAndDoesNotPullTheCamera) {
  const SyntheticOptions options = moving(true);
  const auto source = makeSyntheticSource(options).value();
  const auto compute = ComputeContext::create({}).value();
  const auto pipeline = ScanPipeline::create(*compute, {options.K, ScanParams{}}).value();
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  double squares = 0, farthest_m = 0;
  int frames = 0;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const Result<FrameResult> result = pipeline->processFrame(read.frame);
    ASSERT_TRUE(result) << result.error().message();
    if (frames == 0) T_world_map = *read.frame.T_world_camera;
    ASSERT_EQ(result->pose.state, TrackingState::tracking) << read.frame.index;
    const Eigen::Vector3d truth = (T_world_map.inverse() * *read.frame.T_world_camera).translation();
    const double off_m = (result->pose.T_world_camera.translation() - truth).norm();
    farthest_m = std::max(farthest_m, off_m);
    squares += off_m * off_m;
    ++frames;
  }
  EXPECT_EQ(frames, 420);
  // Not aligned: the ATE would be less. Without the motion filter somebody's way past the camera took it
  // along for up to 180 mm.
  EXPECT_LT(std::sqrt(squares / frames), 0.015);
  EXPECT_LT(farthest_m, 0.040);

  const TrueSurface truth = whatIsThereAtTheEnd();
  std::int64_t points = 0, ghosts = 0;
  const Result<void> read = pipeline->forEachCloudPoint([&](const LabelPoint& point) {
    ++points;
    if (!truth.isNear(T_world_map * Eigen::Vector3d(point.x, point.y, point.z), 4)) ++ghosts;
  });
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_GT(points, 300000);
  EXPECT_LT(static_cast<double>(ghosts), 0.001 * static_cast<double>(points)) << ghosts << " ghosts";
}

}  // namespace
}  // namespace scantrove::test
