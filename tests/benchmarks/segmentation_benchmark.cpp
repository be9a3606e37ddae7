// Merged regions compared with single frames over random scenes with exact truth. Runs the scan pipeline and
// evaluates both every few frames, as the images of --label-maps. Prints a line per scene, and means, for
// each set of parameters.
//
//   segmentation_benchmark --cache DIR --rooms 1-5 --tables 1-5,11-15:hard [--hands 1-3] [--uneven] [--hard]
//   [--rule graph,thesis] [--set key=value]
#include <cstdio>

#include "core/evaluation/segmentation_metrics.h"
#include "core/segmentation/upsample_segments.h"
#include "core/session/param_registry.h"
#include "tests/benchmarks/scene_scan.h"
#include "tests/benchmarks/small_losses.h"

namespace scantrove::benchmarks {
namespace {

struct Options {
  SceneOptions scenes;
  std::vector<std::string> rules;
};

/// A named set of parameters.
struct Variant {
  std::string name;
  ScanParams params;
};

struct SceneScore {
  SegmentationMetrics single, merged;
  SmallLosses losses;
  double regions = 0;
  double merge_ms = 0;
  double fps = 0;
  double lost = 0;
  double drift_mm = 0;
};

Result<std::vector<Variant>> variantsOf(const Options& options) {
  std::vector<std::string> rules = options.rules;
  if (rules.empty()) rules.emplace_back();
  std::vector<Variant> variants;
  for (const std::string& rule : rules) {
    Variant variant{rule.empty() ? "default" : rule, {}};
    if (!rule.empty()) SCANTROVE_TRY(applySetting(variant.params, "labeling.rule=" + rule));
    for (const std::string& setting : options.scenes.settings) {
      SCANTROVE_TRY(applySetting(variant.params, setting));
      variant.name += ' ' + setting;
    }
    variants.push_back(std::move(variant));
  }
  return variants;
}

/// Segments or regions of a frame at the resolution of its depth image, as a scan writes them.
class LabelImages {
 public:
  LabelImages(const SegmentMap& segments, const RgbdFrame& frame)
      : depth_(frame.depth),
        upsampler_(segments.depths_m, segments.width, segments.height,
                   {frame.depth.cols,
                    frame.depth.rows,
                    {frame.depth.ptr<std::uint16_t>(), frame.depth.total()},
                    frame.meters_per_unit}) {}

  template <class Ids>
  [[nodiscard]] cv::Mat of(const Ids& ids) const {
    const Ids large = upsampler_.apply(ids);
    cv::Mat1i image(depth_.size());
    std::ranges::transform(large, image.begin(), [](const auto id) { return numberOf(id); });
    return image;
  }

 private:
  static int numberOf(std::uint32_t segment) { return static_cast<int>(segment); }
  static int numberOf(RegionId region) { return static_cast<int>(region.value); }

  cv::Mat depth_;
  DepthUpsampler upsampler_;
};

/// Mean time per frame of the stage that joins and splits regions.
double mergeMilliseconds(const StageTimer& timer) {
  double sum = 0;
  std::size_t frames = 1;
  for (const StageTimer::Stage& stage : timer.stages()) {
    if (stage.name != "merge") continue;
    for (const double ms : stage.all_ms) sum += ms;
    frames = std::max(frames, stage.all_ms.size());
  }
  return sum / static_cast<double>(frames);
}

Result<SceneScore> scoreOf(const std::filesystem::path& recording, const ScanParams& params,
                           const Options& options, ComputeContext& compute) {
  std::vector<SegmentationMetrics> single, merged;
  SceneScore score;
  const auto scan = scanScene(recording, params, options.scenes, compute,
                              [&](const MappingPipeline& pipeline, const RgbdFrame& frame,
                                  const FrameResult& result, const cv::Mat& truth) {
                                const LabelImages images(result.segments, frame);
                                single.push_back(evaluateSegmentation(images.of(result.segments.ids), truth));
                                merged.push_back(evaluateSegmentation(images.of(result.view.regions), truth));
                                score.losses +=
                                    countSmallLosses(result, truthIn(truth, pipeline.workingIntrinsics()));
                              });
  if (!scan) return fail(scan.error());
  score.single = averaged(single);
  score.merged = averaged(merged);
  score.regions = scan->pipeline->readout().regionCount().regions;
  score.merge_ms = mergeMilliseconds(scan->pipeline->timer());
  score.fps = scan->frames / scan->seconds;
  score.lost = scan->lost;
  score.drift_mm = scan->drift_mm;
  return score;
}

void printHeader(const Variant& variant) {
  std::printf(
      "\n== %s\n%-18s |  error 4.1 px            | small over half        | large over half | small objects: "
      "segment had / lost as mixed, joined, split / won |\n",
      variant.name.c_str(), "");
  std::printf(
      "%-18s | single merged  ratio     | single merged  gain    | single merged   | had mixed join split "
      "won | regions merge_ms fps "
      "lost drift_mm\n",
      "scene");
}

void printLine(const std::string& name, const SceneScore& s, double ratio) {
  const auto& [single, merged] = std::pair(s.single, s.merged);
  std::printf(
      "%-18s | %6.2f %6.2f  %5.3f     | %6.3f %6.3f %+6.3f   | %6.3f %6.3f   | %5d %4d %4d %4d %4d | %7.0f "
      "%8.2f %3.0f %4.0f "
      "%8.1f\n",
      name.c_str(), single.boundary_error, merged.boundary_error, ratio, single.small.over_half,
      merged.small.over_half, merged.small.over_half - single.small.over_half, single.large.over_half,
      merged.large.over_half, s.losses.covered, s.losses.mixed, s.losses.joined, s.losses.split, s.losses.won,
      s.regions, s.merge_ms, s.fps, s.lost, s.drift_mm);
  std::fflush(stdout);
}

/// Means over scenes, with equal weights, also of the ratio.
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
    mean.losses += score.losses;
    ratio += share * score.merged.boundary_error / score.single.boundary_error;
  }
  printLine(name, mean, ratio);
}

Result<void> run(const Options& options) {
  const auto variants = variantsOf(options);
  if (!variants) return fail(variants.error());
  auto compute = ComputeContext::create({});
  if (!compute) return fail(compute.error());
  const SceneCache cache(options.scenes.cache, options.scenes.frames);
  for (const Variant& variant : *variants) {
    printHeader(variant);
    std::vector<SceneScore> all;
    for (const char* kind : {"room", "tabletop", "hands"}) {
      std::vector<SceneScore> of_kind;
      for (const std::string& scene : options.scenes.scenesOf(kind)) {
        const auto recording = cache.recordingOf(scene);
        if (!recording) return fail(recording.error());
        const auto score = scoreOf(*recording, variant.params, options, **compute);
        if (!score) return fail(score.error());
        printLine(scene, *score, score->merged.boundary_error / score->single.boundary_error);
        of_kind.push_back(*score);
        all.push_back(*score);
      }
      printMean(fmt::format("mean of {}", kind), of_kind);
    }
    printMean("mean of all", all);
  }
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove::benchmarks;
  Options options;
  return withScenes(
      argc, argv, "Single frames compared with merged regions on random scenes", options.scenes,
      [&] { return run(options); },
      [&](CLI::App& app) {
        app.add_option("--rule", options.rules, "rules of labeling to compare")->delimiter(',');
      });
}
