#pragma once
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/pipeline/mapping_pipeline.h"
#include "core/session/param_registry.h"
#include "tests/benchmarks/scene_cache.h"

namespace scantrove::benchmarks {

/// Options: the random scenes and how to scan them.
struct SceneOptions {
  std::string cache;
  std::vector<std::string> rooms, tables, hands;  ///< "1-3", "7", "5:uneven", "6-9:hard"
  bool bumpy = false;
  bool hard = false;
  std::vector<std::string> settings;
  std::string poses = "tracked";
  int every = 5;
  int frames = 0;  ///< 0: all
  int stride = 1;

  void addTo(CLI::App& app) {
    app.add_option("--cache", cache, "folder that keeps the rendered scenes")->required();
    app.add_option("--rooms", rooms, "seeds of demo:room, such as 1-5,9,7:uneven,11-15:hard")->delimiter(',');
    app.add_option("--tables", tables, "seeds of demo:tabletop")->delimiter(',');
    app.add_option("--hands", hands, "seeds of demo:hands")->delimiter(',');
    app.add_flag("--uneven", bumpy, "surfaces with bumps, in all scenes");
    app.add_flag("--hard", hard, "all rooms and tables of the hard generation");
    app.add_option("--set", settings, "parameters, key=value");
    app.add_option("--poses", poses, "tracked or given")->check(CLI::IsMember({"tracked", "given"}));
    app.add_option("--every", every, "compare every N-th frame with the truth")->check(CLI::PositiveNumber);
    app.add_option("--frames", frames, "only the first N of each scene");
    app.add_option("--stride", stride, "every N-th frame")->check(CLI::PositiveNumber);
  }

  /// The scenes of a kind ("room", "tabletop" or "hands"), named as after "demo:".
  [[nodiscard]] std::vector<std::string> scenesOf(const std::string& kind) const {
    std::vector<std::string> scenes;
    for (const std::string& range : kind == "room" ? rooms : (kind == "hands" ? hands : tables)) {
      const std::size_t colon = std::min(range.find(':'), range.size());
      const std::size_t dash = std::min(range.find('-'), colon);
      const int first = std::stoi(range);
      const int last = dash < colon ? std::stoi(range.substr(dash + 1)) : first;
      const std::string modes = (bumpy ? ":uneven" : range.substr(colon)) + (hard ? ":hard" : "");
      for (int seed = first; seed <= last; ++seed)
        scenes.push_back(fmt::format("{}:{}{}", kind, seed, modes));
    }
    return scenes;
  }
};

/// The main() of a program for random scenes. `add_more` adds its own options.
inline int withScenes(int argc, char** argv, const std::string& what_for, SceneOptions& options,
                      const std::function<Result<void>()>& run,
                      const std::function<void(CLI::App&)>& add_more = {}) {
  CLI::App app(what_for);
  options.addTo(app);
  if (add_more) add_more(app);
  CLI11_PARSE(app, argc, argv);
  const Result<void> done = run();
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 1;
}

/// The result of a scan.
struct SceneScan {
  std::unique_ptr<MappingPipeline> pipeline;
  int frames = 0;
  int lost = 0;
  double seconds = 0;
  double drift_mm = 0;  ///< largest position error of the tracked camera
};

/// The true instances of a frame in a recording of SceneCache.
inline Result<cv::Mat> truthAt(const std::filesystem::path& recording, int frame_index) {
  return readLabelImage(recording / fmt::format("frame-{:06}.instance.png", frame_index));
}

/// True instances in images of `K`.
inline cv::Mat truthIn(const cv::Mat& truth, const Intrinsics& K) {
  cv::Mat resized;
  cv::resize(truth, resized, {K.width, K.height}, 0, 0, cv::INTER_NEAREST_EXACT);
  return resized;
}

/// Called with a frame of the recording, its result, and its true instances at the recording's resolution.
using FrameVisit =
    std::function<void(const MappingPipeline&, const RgbdFrame&, const FrameResult&, const cv::Mat& truth)>;

/// Scans a recording of SceneCache; visits every `options.every`-th frame if it has a pose.
inline Result<SceneScan> scanScene(const std::filesystem::path& recording, const ScanParams& params,
                                   const SceneOptions& options, ComputeContext& compute,
                                   const FrameVisit& visit) {
  SourceOptions which;
  which.stride = options.stride;
  if (options.frames > 0) which.frames = options.frames;
  const auto source = openSource(recording.string(), which);
  if (!source) return fail(source.error());
  SceneScan scan;
  SCANTROVE_TRY(moveInto(
      scan.pipeline,
      MappingPipeline::create(compute, {(*source)->info().intrinsics, params,
                                        options.poses == "given" ? PoseUse::given : PoseUse::none})));
  const auto start = std::chrono::steady_clock::now();
  std::optional<Eigen::Isometry3d> T_truth_estimate;
  for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
       read = (*source)->next()) {
    const auto result = scan.pipeline->processFrame(read.frame);
    if (!result) return fail(result.error());
    scan.pipeline->timer().endFrame();
    ++scan.frames;
    if (!result->pose.usable()) {
      ++scan.lost;
      continue;
    }
    const Eigen::Isometry3d& truth_pose = *read.frame.T_world_camera;
    if (!T_truth_estimate) T_truth_estimate = truth_pose * result->pose.T_world_camera.inverse();
    const Eigen::Isometry3d pose = *T_truth_estimate * result->pose.T_world_camera;
    scan.drift_mm = std::max(scan.drift_mm, 1000 * (pose.translation() - truth_pose.translation()).norm());
    if (scan.frames % options.every != 0) continue;
    const Result<cv::Mat> truth = truthAt(recording, read.frame.index);
    if (!truth) return fail(truth.error());
    visit(*scan.pipeline, read.frame, *result, *truth);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  scan.seconds = elapsed.count();
  return scan;
}

}  // namespace scantrove::benchmarks
