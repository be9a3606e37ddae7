// The dense map after N frames of the kitchen recording (or the demo) with given poses: time to integrate the
// last frame again and to raycast its view. The cost must depend on the view, not on the size of the map.
// Wall time uses all cores of the device; CPU time is that of the process.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>

#include "core/fusion/dense_map.h"
#include "core/fusion/depth_preprocessor.h"
#include "core/scan/open_source.h"
#include "tests/support/source_tree.h"

namespace {

using namespace scantrove;

std::string kitchen() {
  const char* const given = std::getenv("SCANTROVE_DATA");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given) : test::sourceTree() / ".." / "shared/data";
  return std::filesystem::exists(folder / "kitchen") ? (folder / "kitchen").string() : "demo";
}

ComputeContext& device() {
  static auto compute = ComputeContext::create({});
  return **compute;
}

/// The map after some frames of the recording, ready to integrate the last one again.
struct Scan {
  std::unique_ptr<DepthPreprocessor> preprocessor;
  std::unique_ptr<DenseMap> map;
  DepthPyramid frame;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

bool fuse(benchmark::State& state, Scan& scan) {
  auto source = openSource(kitchen(), {});
  if (!source) {
    state.SkipWithError(source.error().message().c_str());
    return false;
  }
  const FusionParams params;
  scan.preprocessor = std::move(*DepthPreprocessor::create(device(), (*source)->info().intrinsics, params));
  scan.map = std::move(*DenseMap::create(device(), params));
  for (int i = 0; i < state.range(0);) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end) break;
    if (read.status != FrameRead::Status::frame || !read.frame.T_world_camera) continue;
    scan.frame = scan.preprocessor->process(read.frame);
    scan.T_world_camera = *read.frame.T_world_camera;
    scan.map->integrate(scan.frame, scan.T_world_camera);
    ++i;
  }
  return true;
}

void integrate(benchmark::State& state) {
  Scan scan;
  if (!fuse(state, scan)) return;
  for (auto _ : state) {
    scan.map->integrate(scan.frame, scan.T_world_camera);
    device().finish();
  }
  state.counters["bricks"] = scan.map->bricks().brickCount();
}
BENCHMARK(integrate)->Arg(5)->Arg(50)->Arg(480)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);

void raycast(benchmark::State& state) {
  Scan scan;
  if (!fuse(state, scan)) return;
  SurfaceMaps surface;
  for (auto _ : state) {
    scan.map->raycast(scan.T_world_camera, scan.frame.K.resizedTo(320, 240), surface);
    device().finish();
  }
  state.counters["bricks"] = scan.map->bricks().brickCount();
}
BENCHMARK(raycast)->Arg(5)->Arg(50)->Arg(480)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
