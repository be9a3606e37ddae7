// GraphSegmenter and its stages on one thread, on a realistic surface: boxes on a table with noise of a
// structured-light camera.
#include <benchmark/benchmark.h>

#include <random>

#include "core/segmentation/edge_weigher.h"
#include "core/segmentation/graph_partition.h"
#include "core/segmentation/graph_segmenter.h"
#include "core/segmentation/normal_refiner.h"

namespace {

using namespace scantrove;

SurfaceMaps tableTop(ComputeContext& compute, int width) {
  const Intrinsics K = Intrinsics{525, 525, 319.5F, 239.5F, 640, 480}.resizedTo(width, width * 3 / 4);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.001F);
  std::vector<cl_float4> vertices;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const float x = (static_cast<float>(u) - K.cx) / K.fx, y = (static_cast<float>(v) - K.cy) / K.fy;
      const bool box = static_cast<int>(x * 8 + 20) % 2 == 0 && static_cast<int>(y * 8 + 20) % 2 == 0;
      const float z = 0.7F / (0.6F + 0.8F * y) - (box ? 0.08F : 0.0F) + noise(random);
      const Eigen::Vector3f p = K.backProject(static_cast<float>(u), static_cast<float>(v), z);
      vertices.push_back({{p.x(), p.y(), p.z(), z > 0 && z < 4 ? 1.0F : 0.0F}});
    }
  }
  SurfaceMaps surface;
  surface.K = K;
  surface.vertices_world = Buffer<cl_float4>(compute.context(), vertices.size());
  surface.normals_world = Buffer<cl_float4>(compute.context(), vertices.size());
  surface.vertices_world.write(compute.queue(), vertices);
  return surface;
}

ComputeContext& device() {
  static auto compute = ComputeContext::create({});
  return **compute;
}

void segment(benchmark::State& state) {
  const SurfaceMaps surface = tableTop(device(), static_cast<int>(state.range(0)));
  auto segmenter = GraphSegmenter::create(device());
  int segments = 0;
  for (auto _ : state) segments = (*segmenter)->segment(surface, {}).count();
  state.counters["segments"] = segments;
}
BENCHMARK(segment)->Arg(320)->Arg(640)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void refineNormals(benchmark::State& state) {
  const SurfaceMaps surface = tableTop(device(), static_cast<int>(state.range(0)));
  auto refiner = NormalRefiner::create(device());
  for (auto _ : state) {
    benchmark::DoNotOptimize(refiner->refine(surface, {}).size());
    device().finish();
  }
}
BENCHMARK(refineNormals)->Arg(320)->Arg(640)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void weighEdges(benchmark::State& state) {
  const SurfaceMaps surface = tableTop(device(), static_cast<int>(state.range(0)));
  auto refiner = NormalRefiner::create(device());
  auto weigher = EdgeWeigher::create(device());
  const Buffer<cl_float4>& normals = refiner->refine(surface, {});
  EdgeKeys edges;
  for (auto _ : state) weigher->weigh(surface, normals, {}, edges);
}
BENCHMARK(weighEdges)->Arg(320)->Arg(640)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void sortTheEdges(benchmark::State& state) {
  const SurfaceMaps surface = tableTop(device(), static_cast<int>(state.range(0)));
  auto refiner = NormalRefiner::create(device());
  auto weigher = EdgeWeigher::create(device());
  EdgeKeys edges;
  weigher->weigh(surface, refiner->refine(surface, {}), {}, edges);
  const std::span<const std::uint16_t> keys(edges.keys.data()->s, edges.keys.size() * 4);
  std::vector<std::uint32_t> counts, order;
  for (auto _ : state) sortEdges(keys, counts, order);
}
BENCHMARK(sortTheEdges)->Arg(320)->Arg(640)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

}  // namespace
