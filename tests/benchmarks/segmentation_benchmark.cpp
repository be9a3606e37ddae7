// How much better merged regions are than single frames, over random scenes with exact truth: the scan
// pipeline on each scene, every few frames both compared with the truth. One line a scene, and means, for
// each set of parameters.
//
//   segmentation_benchmark --cache DIR --rooms 1-5 --tables 1-5 [--uneven] [--rule graph,thesis] [--set
//   key=value]
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/evaluation/segmentation_metrics.h"
#include "core/scan/param_registry.h"
#include "core/scan/scan_pipeline.h"
#include "tests/benchmarks/scene_cache.h"

namespace scantrove::benchmarks {
namespace {

struct Options {
  std::string cache;
  std::vector<std::string> rooms, tables;
  bool uneven = false;
  std::vector<std::string> rules;
  std::vector<std::string> settings;
  std::string poses = "tracked";
  int every = 5;
  int frames = 0;
  int stride = 1;
};

/// A set of parameters and what it is called.
struct Variant {
  std::string name;
  ScanParams params;
};

struct SceneScore {
  SegmentationMetrics single, merged;
  double regions = 0;
  double merge_ms = 0;
  double fps = 0;
  double lost = 0;
  double drift_mm = 0;  // farthest that the tracked camera was from where it should be
};

/// "1-3" and "7": 1 2 3 7.
std::vector<int> seedsFrom(const std::vector<std::string>& ranges) {
  std::vector<int> seeds;
  for (const std::string& range : ranges) {
    const std::size_t dash = range.find('-');
    const int first = std::stoi(range);
    const int last = dash == std::string::npos ? first : std::stoi(range.substr(dash + 1));
    for (int seed = first; seed <= last; ++seed) seeds.push_back(seed);
  }
  return seeds;
}

Result<std::vector<Variant>> variantsOf(const Options& options) {
  std::vector<std::string> rules = options.rules;
  if (rules.empty()) rules.emplace_back();
  std::vector<Variant> variants;
  for (const std::string& rule : rules) {
    Variant variant{rule.empty() ? "default" : rule, {}};
    if (!rule.empty()) SCANTROVE_TRY(applySetting(variant.params, "labeling.rule=" + rule));
    for (const std::string& setting : options.settings) {
      SCANTROVE_TRY(applySetting(variant.params, setting));
      variant.name += ' ' + setting;
    }
    variants.push_back(std::move(variant));
  }
  return variants;
}

cv::Mat labelImage(const std::vector<std::uint32_t>& labels, const Intrinsics& K) {
  cv::Mat_<int> image(K.height, K.width);
  std::copy(labels.begin(), labels.end(), image.begin());
  return image;
}

/// Mean time a frame in the stages that join and part regions.
std::vector<std::uint32_t> numbersOf(const std::vector<RegionId>& regions) {
  std::vector<std::uint32_t> numbers(regions.size());
  std::ranges::transform(regions, numbers.begin(), [](RegionId region) { return region.value; });
  return numbers;
}

double mergeMilliseconds(const StageTimer& timer) {
  double sum = 0;
  std::size_t frames = 1;
  for (const StageTimer::Stage& stage : timer.stages()) {
    if (stage.name != "merge" && stage.name != "partition") continue;
    for (const double ms : stage.all_ms) sum += ms;
    frames = std::max(frames, stage.all_ms.size());
  }
  return sum / static_cast<double>(frames);
}

Result<SceneScore> scoreOf(const std::filesystem::path& recording, const ScanParams& params,
                           const Options& options, ComputeContext& compute) {
  SourceOptions frames;
  frames.stride = options.stride;
  if (options.frames > 0) frames.frames = options.frames;
  const auto source = openSource(recording.string(), frames);
  if (!source) return fail(source.error());
  const bool given = options.poses == "given";
  const auto pipeline =
      ScanPipeline::create(compute, {(*source)->info().intrinsics, params, given, nullptr, 0});
  if (!pipeline) return fail(pipeline.error());
  const Intrinsics& K = (*pipeline)->workingIntrinsics();
  std::vector<SegmentationMetrics> single, merged;
  SceneScore score;
  const auto start = std::chrono::steady_clock::now();
  int done = 0;
  std::optional<Eigen::Isometry3d> T_truth_estimate;
  for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
       read = (*source)->next()) {
    const auto result = (*pipeline)->processFrame(read.frame);
    if (!result) return fail(result.error());
    ++done;
    if (!result->pose.usable()) {
      score.lost += 1;
      continue;
    }
    const Eigen::Isometry3d& truth_pose = *read.frame.T_world_camera;
    if (!T_truth_estimate) T_truth_estimate = truth_pose * result->pose.T_world_camera.inverse();
    const Eigen::Isometry3d pose = *T_truth_estimate * result->pose.T_world_camera;
    score.drift_mm = std::max(score.drift_mm, 1000 * (pose.translation() - truth_pose.translation()).norm());
    if (done % options.every != 0) continue;
    const std::string name = fmt::format("frame-{:06}.instance.png", read.frame.index);
    const auto truth = readLabelImage(recording / name);
    if (!truth) return fail(truth.error());
    cv::Mat small;
    cv::resize(*truth, small, {K.width, K.height}, 0, 0, cv::INTER_NEAREST_EXACT);
    single.push_back(evaluateSegmentation(labelImage(result->segments.ids, K), small));
    merged.push_back(evaluateSegmentation(labelImage(numbersOf(result->regions.regions), K), small));
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  score.fps = done / elapsed.count();
  score.single = averaged(single);
  score.merged = averaged(merged);
  score.merge_ms = mergeMilliseconds((*pipeline)->timer());
  score.regions = (*pipeline)->regionCount().regions;
  return score;
}

void printHeader(const Variant& variant) {
  std::printf("\n== %s\n%-18s |  error 4.1 px            | small over half        | large over half |\n",
              variant.name.c_str(), "");
  std::printf(
      "%-18s | single merged  ratio     | single merged  gain    | single merged   | regions merge_ms fps "
      "lost\n",
      "scene");
}

void printLine(const std::string& name, const SceneScore& s, double ratio) {
  const auto& [single, merged] = std::pair(s.single, s.merged);
  std::printf(
      "%-18s | %6.2f %6.2f  %5.3f     | %6.3f %6.3f %+6.3f   | %6.3f %6.3f   | %7.0f %8.2f %3.0f %4.0f "
      "%8.1f\n",
      name.c_str(), single.boundary_error, merged.boundary_error, ratio, single.small.over_half,
      merged.small.over_half, merged.small.over_half - single.small.over_half, single.large.over_half,
      merged.large.over_half, s.regions, s.merge_ms, s.fps, s.lost, s.drift_mm);
  std::fflush(stdout);
}

/// Means over scenes; of the ratio too, as each scene counts as one.
void printMean(const std::string& name, const std::vector<SceneScore>& scores) {
  if (scores.empty()) return;
  SceneScore mean;
  double ratio = 0;
  for (const SceneScore& score : scores) {
    const double share = 1.0 / static_cast<double>(scores.size());
    for (const auto part : {&SceneScore::single, &SceneScore::merged}) {
      (mean.*part).boundary_error += share * (score.*part).boundary_error;
      (mean.*part).small.over_half += share * (score.*part).small.over_half;
      (mean.*part).large.over_half += share * (score.*part).large.over_half;
    }
    for (const auto part : {&SceneScore::regions, &SceneScore::merge_ms, &SceneScore::fps,
                            &SceneScore::drift_mm, &SceneScore::lost}) {
      mean.*part += share * score.*part;
    }
    ratio += share * score.merged.boundary_error / score.single.boundary_error;
  }
  printLine(name, mean, ratio);
}

Result<void> run(const Options& options) {
  const auto variants = variantsOf(options);
  if (!variants) return fail(variants.error());
  auto compute = ComputeContext::create({});
  if (!compute) return fail(compute.error());
  const SceneCache cache(options.cache);
  for (const Variant& variant : *variants) {
    printHeader(variant);
    std::vector<SceneScore> all;
    for (const auto& [kind, seeds] :
         {std::pair("room", &options.rooms), std::pair("tabletop", &options.tables)}) {
      std::vector<SceneScore> of_kind;
      for (const int seed : seedsFrom(*seeds)) {
        const std::string scene = fmt::format("{}:{}{}", kind, seed, options.uneven ? ":uneven" : "");
        const auto recording = cache.recordingOf(scene);
        if (!recording) return fail(recording.error());
        const auto score = scoreOf(*recording, variant.params, options, **compute);
        if (!score) return fail(score.error());
        printLine(scene, *score, score->merged.boundary_error / score->single.boundary_error);
        of_kind.push_back(*score);
        all.push_back(*score);
      }
      printMean(fmt::format("mean of {}s", kind), of_kind);
    }
    printMean("mean of all", all);
  }
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove;
  benchmarks::Options options;
  CLI::App app("Single frames against merged regions on random scenes");
  app.add_option("--cache", options.cache, "folder that keeps the rendered scenes")->required();
  app.add_option("--rooms", options.rooms, "seeds of demo:room, such as 1-5,9")->delimiter(',');
  app.add_option("--tables", options.tables, "seeds of demo:tabletop")->delimiter(',');
  app.add_flag("--uneven", options.uneven, "surfaces with bumps");
  app.add_option("--rule", options.rules, "rules of labeling to compare")->delimiter(',');
  app.add_option("--set", options.settings, "parameters, key=value, for all of them");
  app.add_option("--poses", options.poses, "tracked or given")->check(CLI::IsMember({"tracked", "given"}));
  app.add_option("--every", options.every, "compare every N-th frame with the truth")
      ->check(CLI::PositiveNumber);
  app.add_option("--frames", options.frames, "only the first N of each scene");
  app.add_option("--stride", options.stride, "every N-th frame")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  const auto done = benchmarks::run(options);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
