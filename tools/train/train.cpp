// Trains the models in resources/models on synthetic scenes with exact truth; see README.md.
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "core/base/log.h"
#include "core/compute/compute_context.h"
#include "tools/train/models.h"
#include "tools/train/scene_sampler.h"

namespace scantrove::train {
namespace {

struct Options {
  std::filesystem::path samples, out;
  std::vector<std::string> scenes;
  std::string commit;
  int frames = 200;
  int trees = 300;
};

/// Samples of all scenes, from files where these are there already.
Result<std::vector<SceneSamples>> sampleAll(const Options& options) {
  auto compute = ComputeContext::create({});
  if (!compute) return fail(compute.error());
  std::filesystem::create_directories(options.samples);
  std::vector<SceneSamples> all;
  for (const std::string& scene : options.scenes) {
    std::string name = scene;
    std::ranges::replace(name, ':', '-');
    const std::filesystem::path file = options.samples / (name + ".txt");
    const bool is_there = std::filesystem::exists(file);
    Result<SceneSamples> samples =
        is_there ? readSamples(file, scene) : sampleScene(scene, options.frames, **compute);
    if (!samples) return fail(samples.error());
    if (!is_there) SCANTROVE_TRY(writeSamples(file, *samples));
    std::fprintf(stderr, "%s: %zu samples of region sets, %zu of borders\n", scene.c_str(),
                 samples->objectness.size(), samples->borders.size());
    all.push_back(std::move(*samples));
  }
  return all;
}

Result<void> write(const std::filesystem::path& file, const Result<std::string>& model) {
  if (!model) return fail(model.error());
  std::ofstream out(file);
  out << *model;
  out.close();
  if (!out) return fail("The model cannot be written to " + file.string() + ".", "Is the disk full?");
  std::printf("%s\n", file.c_str());
  return {};
}

Result<void> train(const Options& options) {
  const auto samples = sampleAll(options);
  if (!samples) return fail(samples.error());
  const Provenance provenance{
      options.commit,
      fmt::format("demo:{} of {} frames each", fmt::join(options.scenes, " demo:"), options.frames)};
  SCANTROVE_TRY(write(options.out / "border.json", trainBorder(*samples, provenance, options.trees)));
  return write(options.out / "objectness.json", trainObjectness(*samples, provenance, options.trees));
}

}  // namespace
}  // namespace scantrove::train

int main(int argc, char** argv) {
  scantrove::initializeLog();
  scantrove::train::Options options;
  CLI::App app("Trains the objectness and the border model on synthetic scenes");
  app.add_option("--commit", options.commit, "of the program that scans")->required();
  app.add_option("--samples", options.samples, "folder that keeps what the scans gave, for the next run")
      ->required();
  app.add_option("--out", options.out, "folder of the models")->check(CLI::ExistingDirectory)->required();
  app.add_option("--frames", options.frames, "of each scene")->check(CLI::PositiveNumber);
  app.add_option("--trees", options.trees, "at most so many, for a quick trial")->check(CLI::PositiveNumber);
  app.add_option("scenes", options.scenes, "synthetic scenes, as after 'demo:'")->required();
  CLI11_PARSE(app, argc, argv);
  const auto done = scantrove::train::train(options);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
