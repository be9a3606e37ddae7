#include "app/bench_statistics.h"

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <sstream>

#include "app/json_output.h"
#include "core/base/stage_timer.h"

namespace scantrove {
namespace {

double sumOfMedians(const ScanReport& report) {
  double sum = 0;
  for (const ScanReport::Stage& stage : report.stages) sum += stage.median_ms;
  return sum;
}

}  // namespace

BenchSample sampleOf(const ScanSnapshot& snapshot) {
  BenchSample sample;
  sample.frames_done = snapshot.frames.done();
  sample.bricks = snapshot.map_bricks;
  for (const ScanSnapshot::StageTime& stage : snapshot.stage_times) {
    sample.frame_ms += stage.ms;
    sample.stages_ms[stage.name] = stage.ms;
    if (stage.name == "integrate" || stage.name == "raycast") sample.map_ms += stage.ms;
  }
  return sample;
}

std::vector<BenchQuarter> quartersOf(const std::vector<BenchSample>& samples) {
  std::vector<BenchQuarter> quarters;
  if (samples.empty()) return quarters;
  const int last = samples.back().frames_done;
  auto begin = samples.begin();
  for (int quarter = 1; quarter <= 4; ++quarter) {
    const auto end = std::find_if(begin, samples.end(), [&](const BenchSample& s) {
      return 4LL * s.frames_done > 1LL * quarter * last;
    });
    if (begin == end) continue;
    std::vector<double> frame_ms, map_ms;
    std::map<std::string, std::vector<double>> stages_ms;
    for (auto sample = begin; sample != end; ++sample) {
      frame_ms.push_back(sample->frame_ms);
      map_ms.push_back(sample->map_ms);
      for (const auto& [stage, ms] : sample->stages_ms) stages_ms[stage].push_back(ms);
    }
    const BenchSample& newest = *std::prev(end);
    quarters.push_back(
        {newest.frames_done, newest.bricks, summarize(frame_ms).median_ms, summarize(map_ms).median_ms, {}});
    for (const auto& [stage, all_ms] : stages_ms)
      quarters.back().stage_medians_ms[stage] = summarize(all_ms).median_ms;
    begin = end;
  }
  return quarters;
}

std::optional<MapGrowth> mapGrowthOf(const std::vector<BenchSample>& samples) {
  constexpr int kEarly = MapGrowth::kEarlyFrame;
  constexpr int kHalf = MapGrowth::kHalfWindow;
  if (samples.empty() || samples.back().frames_done - 2 * kHalf <= kEarly + kHalf) return std::nullopt;
  std::vector<double> early_ms, late_ms;
  for (const BenchSample& sample : samples) {
    if (std::abs(sample.frames_done - kEarly) <= kHalf) early_ms.push_back(sample.map_ms);
    if (sample.frames_done >= samples.back().frames_done - 2 * kHalf) late_ms.push_back(sample.map_ms);
  }
  if (early_ms.empty()) return std::nullopt;
  return MapGrowth{summarize(early_ms).median_ms, summarize(late_ms).median_ms};
}

std::string benchTable(const ScanReport& report, const std::vector<BenchSample>& samples) {
  std::ostringstream text;
  const double sum = sumOfMedians(report);
  text << std::fixed << std::setprecision(1) << report.source << " on " << report.device << ": "
       << report.frames.read << " frames, " << report.frames.lost << " lost, " << report.fps
       << " fps, peak memory " << report.peak_memory_mb
       << " MiB\n\nstage          median ms   p95 ms    share   medians by quarter\n";
  const std::vector<BenchQuarter> quarters = quartersOf(samples);
  for (const ScanReport::Stage& stage : report.stages) {
    text << std::left << std::setw(14) << stage.name << std::right << std::setw(10) << stage.median_ms
         << std::setw(9) << stage.p95_ms << std::setw(8) << (sum > 0 ? 100 * stage.median_ms / sum : 0)
         << " %";
    for (const BenchQuarter& quarter : quarters) {
      const auto of = quarter.stage_medians_ms.find(stage.name);
      text << std::setw(7) << (of != quarter.stage_medians_ms.end() ? of->second : 0);
    }
    text << '\n';
  }
  text << std::left << std::setw(14) << "frame" << std::right << std::setw(10) << report.frame_median_ms
       << std::setw(9) << report.frame_p95_ms
       << "\n\nto frame     bricks   frame ms   map ms (medians by quarter)\n";
  for (const BenchQuarter& quarter : quarters) {
    text << std::setw(8) << quarter.last_frame << std::setw(11) << quarter.bricks << std::setw(11)
         << quarter.frame_median_ms << std::setw(9) << quarter.map_median_ms << '\n';
  }
  if (!report.slowest_frames.empty()) text << "\nslowest        frame ms   stage furthest above its median\n";
  for (const SlowFrame& slow : report.slowest_frames) {
    text << std::left << std::setw(14) << slow.frame + 1 << std::right << std::setw(9) << slow.total_ms
         << "   " << slow.stage << ' ' << slow.stage_ms << '\n';
  }
  if (!report.kernels.empty()) text << "\nkernel                    mean ms per frame\n";
  for (const ScanReport::Kernel& kernel : report.kernels) {
    text << std::left << std::setw(30) << kernel.name << std::right << std::setw(11) << std::setprecision(2)
         << kernel.mean_ms << '\n';
  }
  if (const auto growth = mapGrowthOf(samples)) {
    text << std::setprecision(1) << "\nmap around frame " << MapGrowth::kEarlyFrame << ": "
         << growth->early_ms << " ms, at the end: " << growth->late_ms << " ms, " << std::setprecision(2)
         << growth->ratio() << " times\n";
  }
  return text.str();
}

nlohmann::ordered_json benchJson(const ScanReport& report, const std::vector<BenchSample>& samples) {
  const double sum = sumOfMedians(report);
  Json stages = Json::object();
  for (const ScanReport::Stage& stage : report.stages) {
    stages[stage.name] = {{"median_ms", stage.median_ms},
                          {"p95_ms", stage.p95_ms},
                          {"share", sum > 0 ? stage.median_ms / sum : 0}};
  }
  Json kernels = Json::object();
  for (const ScanReport::Kernel& kernel : report.kernels)
    kernels[kernel.name] = {{"mean_ms", kernel.mean_ms}};
  Json list = Json::array();
  for (const BenchQuarter& quarter : quartersOf(samples)) {
    list.push_back({{"to_frame", quarter.last_frame},
                    {"bricks", quarter.bricks},
                    {"frame_median_ms", quarter.frame_median_ms},
                    {"map_median_ms", quarter.map_median_ms},
                    {"stage_median_ms", quarter.stage_medians_ms}});
  }
  Json slowest = Json::array();
  for (const SlowFrame& slow : report.slowest_frames) {
    slowest.push_back({{"frame", slow.frame + 1},
                       {"total_ms", slow.total_ms},
                       {"stage", slow.stage},
                       {"stage_ms", slow.stage_ms}});
  }
  Json growth;
  if (const auto map = mapGrowthOf(samples)) {
    growth = {{"around_frame_50_ms", map->early_ms}, {"at_end_ms", map->late_ms}, {"ratio", map->ratio()}};
  }
  return {{"source", report.source},
          {"device", report.device},
          {"frames", report.frames.read},
          {"lost", report.frames.lost},
          {"fps", report.fps},
          {"frame_ms", {{"median", report.frame_median_ms}, {"p95", report.frame_p95_ms}}},
          {"slowest_frames", slowest},
          {"peak_memory_mb", report.peak_memory_mb},
          {"stages", stages},
          {"kernels", kernels},
          {"quarters", list},
          {"map_growth", growth}};
}

}  // namespace scantrove
