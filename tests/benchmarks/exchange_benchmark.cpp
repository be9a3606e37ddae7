#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/exchange/cloud_writer.h"
#include "core/exchange/label_image_writer.h"

namespace scantrove {
namespace {

std::filesystem::path scratchFile(const char* name) { return std::filesystem::temp_directory_path() / name; }

void BM_WriteCloud(benchmark::State& state,
                   Result<void> (*write)(const std::filesystem::path&, const LabeledCloud&,
                                         const Eigen::Vector3d&, const std::string&)) {
  std::mt19937 random(1);
  LabeledCloud points(static_cast<std::size_t>(state.range(0)));
  for (LabeledPoint& p : points) {
    p.x = static_cast<float>(random() % 3000) * 1e-3F;
    p.label = static_cast<std::uint32_t>(random() % 200);
  }
  const auto path = scratchFile("scantrove-benchmark-cloud");
  for (auto _ : state) SCANTROVE_CHECK(write(path, points, Eigen::Vector3d::Zero(), kCloudComment));
  std::filesystem::remove(path);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_CAPTURE(BM_WriteCloud, pcd, writePcd)->Arg(500000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_WriteCloud, ply, writePly)->Arg(500000)->Unit(benchmark::kMillisecond);

void BM_WriteLabelImage(benchmark::State& state) {
  std::vector<std::uint32_t> labels(640 * 480);
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i] = static_cast<std::uint32_t>(i % 640 / 80 + i / 640 / 80 * 8);
  const auto path = scratchFile("scantrove-benchmark-labels.png");
  for (auto _ : state) SCANTROVE_CHECK(writeLabelImage(path, labels, {640, 480}));
  std::filesystem::remove(path);
}
BENCHMARK(BM_WriteLabelImage)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scantrove
