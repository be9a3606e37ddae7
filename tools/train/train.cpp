// Trains the models in resources/models on synthetic scenes with exact truth; see README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "core/base/log.h"
#include "core/compute/compute_context.h"
#include "core/discovery/objectness/objectness_features.h"
#include "core/exchange/atomic_file.h"
#include "core/labeling/border_features.h"
#include "tools/train/models.h"
#include "tools/train/sample_folder.h"
#include "tools/train/scene_sampler.h"

namespace scantrove::train {
namespace {

struct Options {
  std::filesystem::path samples, out;
  std::vector<std::string> scenes;
  std::string commit;
  int frames = 200;
  TrainingOptions training;
};

/// Error: the options ask for nothing, or contradict each other.
Result<void> checkOptions(const Options& options) {
  if (options.scenes.empty() && options.out.empty())
    return fail("There is nothing to do.", "Name scenes to scan, or --out to train on the samples.");
  if (!options.scenes.empty() && options.commit.empty())
    return fail("Scenes need --commit.", "It is stored with their samples and in the models.");
  for (const std::string& name : options.training.left_out) {
    const auto has = [&name](const auto& names) { return std::ranges::find(names, name) != names.end(); };
    if (!has(namesOf(kBorderFeatures)) && !has(namesOf(kObjectnessFeatures)))
      return fail("No model has a feature '" + name + "'.",
                  "See core/labeling/border_features.h and core/discovery/objectness/objectness_features.h.");
  }
  return {};
}

/// Scans scenes on one device, which is opened for the first.
class Scanner {
 public:
  explicit Scanner(int frames) : frames_(frames) {}

  Result<SceneSamples> scan(const std::string& scene) {
    if (!compute_) {
      auto compute = ComputeContext::create({});
      if (!compute) return fail(compute.error());
      compute_ = std::move(*compute);
    }
    Result<SceneSamples> samples = sampleScene(scene, frames_, *compute_);
    if (samples)
      std::fprintf(stderr, "%s: %zu samples of region sets, %zu of borders\n", scene.c_str(),
                   samples->objectness.size(), samples->borders.size());
    return samples;
  }

 private:
  int frames_;
  std::unique_ptr<ComputeContext> compute_;
};

/// Fills the folder. All scenes are tried; the first error is returned, others are printed.
Result<void> collectAll(const Options& options) {
  Scanner scanner(options.frames);
  std::optional<Error> first;
  const auto report = [&first](const Error& error) {
    if (first) std::fprintf(stderr, "%s\n", error.message().c_str());
    if (!first) first = error;
  };
  for (const std::string& scene : options.scenes) {
    const auto collected = collectSamples(options.samples, {scene, options.frames, options.commit},
                                          [&scanner](const std::string& name) { return scanner.scan(name); });
    if (!collected) {
      report(collected.error());
    } else if (*collected == Collected::present) {
      std::fprintf(stderr, "%s: the samples are there\n", scene.c_str());
    } else if (*collected == Collected::busy) {
      std::fprintf(stderr, "%s: another process scans it\n", scene.c_str());
      if (!options.out.empty()) report({"Another process scans " + scene + ".", "Train when it has ended."});
    }
  }
  if (first) return fail(*first);
  return {};
}

Result<void> write(const std::filesystem::path& file, const Result<TrainedModel>& model) {
  if (!model) return fail(model.error());
  SCANTROVE_TRY(writeFileAtomically(file, model->file));
  std::printf(
      "%s\nLog loss (lower is better) and area under the curve, on scenes that a model was not trained "
      "on:\n%s\n",
      file.c_str(), model->figures.c_str());
  return {};
}

Result<void> run(const Options& options) {
  SCANTROVE_TRY(checkOptions(options));
  SCANTROVE_TRY(prepareOutputFolder(options.samples));
  SCANTROVE_TRY(collectAll(options));
  if (options.out.empty()) return {};
  const auto scenes = readSampleFolder(options.samples, options.scenes);
  if (!scenes) return fail(scenes.error());
  SCANTROVE_TRY(write(options.out / "border.json", trainBorder(*scenes, options.training)));
  return write(options.out / "objectness.json", trainObjectness(*scenes, options.training));
}

}  // namespace
}  // namespace scantrove::train

int main(int argc, char** argv) {
  scantrove::initializeLog();
  scantrove::train::Options options;
  CLI::App app("Trains the objectness and the border model on synthetic scenes");
  app.add_option(
         "--samples", options.samples,
         "folder of samples; scenes that it holds are not scanned again. Several processes may fill it")
      ->required();
  app.add_option("--commit", options.commit, "of the program that scans");
  app.add_option("--out", options.out,
                 "folder of the models; without it, scenes are only scanned. Without scenes, the models are "
                 "trained on "
                 "all samples of the folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--frames", options.frames, "of each scene")->check(CLI::PositiveNumber);
  app.add_option("--trees", options.training.trees, "at most so many, for a quick trial")
      ->check(CLI::PositiveNumber);
  app.add_option("--leave-out", options.training.left_out,
                 "a feature that the models do not read (repeatable)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);  // the next argument is a scene
  app.add_option("scenes", options.scenes, "synthetic scenes, as after 'demo:'");
  CLI11_PARSE(app, argc, argv);
  const auto done = scantrove::train::run(options);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
