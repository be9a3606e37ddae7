#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "core/evaluation/segmentation_metrics.h"
#include "core/evaluation/trajectory_metrics.h"

namespace scantrove {
namespace {

cv::Mat1i checkerboard(int width, int height, int side) {
  cv::Mat1i labels(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) labels(y, x) = 1 + x / side + y / side * (width / side + 1);
  }
  return labels;
}

void BM_EvaluateSegmentation(benchmark::State& state) {
  const cv::Mat1i truth = checkerboard(640, 480, 64);
  const cv::Mat1i segments = checkerboard(640, 480, 50);
  for (auto _ : state) benchmark::DoNotOptimize(evaluateSegmentation(segments, truth));
}
BENCHMARK(BM_EvaluateSegmentation)->Unit(benchmark::kMillisecond);

void BM_EvaluateTrajectory(benchmark::State& state) {
  Trajectory truth;
  for (int i = 0; i < 1000; ++i) {
    StampedPose pose;
    pose.timestamp_s = i / 30.0;
    pose.T_world_camera.translation() << std::cos(0.01 * i), std::sin(0.02 * i), 0.001 * i;
    truth.push_back(pose);
  }
  for (auto _ : state) {
    const auto pairs = associate(truth, truth);
    benchmark::DoNotOptimize(absoluteTrajectoryError(pairs).rmse);
    benchmark::DoNotOptimize(relativePoseError(pairs).translation_m.rmse);
  }
}
BENCHMARK(BM_EvaluateTrajectory)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scantrove
