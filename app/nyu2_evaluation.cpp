#include "app/nyu2_evaluation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "app/nyu2_results.h"
#include "app/nyu2_scan.h"
#include "app/progress_line.h"
#include "app/stop_signal.h"
#include "core/base/checksum.h"
#include "core/evaluation/nyu2_figure.h"
#include "core/image/png_encoder.h"
#include "core/session/param_registry.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// The numbers of frames, ascending, with those of table 4.1.
std::vector<int> lengthsOf(const Nyu2Evaluation& request) {
  std::set<int> lengths(request.frames.begin(), request.frames.end());
  for (int n = 1; request.frames.empty() && n <= kNyu2LongestScan; ++n) lengths.insert(n);
  lengths.insert({1, kNyu2TableScan});
  return {lengths.begin(), lengths.end()};
}

/// What results depend on: those of another setup are not mixed with them.
Json setupOf(const NyuLabeledFile& labeled, const Nyu2Evaluation& request, const ScanParams& params,
             const std::string& device) {
  std::string origins;
  for (const NyuOrigin& origin : labeled.origins()) origins += origin.depth_file + '\n';
  std::error_code ignored;
  Json parameters = Json::object();
  for (const ParamInfo& info : paramRegistry()) parameters[info.key] = info.text(params);
  return {{"version", SCANTROVE_VERSION},
          {"device", device},
          {"labelled_images", labeled.origins().size()},
          {"labelled_bytes", fs::file_size(request.labeled, ignored)},
          {"origins_crc32", crc32Of({origins.data(), origins.size()})},
          {"parameters", std::move(parameters)}};
}

/// Median difference in metres of two depth images where both have depth; empty if few pixels have.
std::optional<double> medianDifference(const RgbdFrame& frame, const cv::Mat1f& depth_m) {
  constexpr std::size_t kFewest = 1000;
  std::vector<float> differences;
  for (int y = 0; y < depth_m.rows; y += 2) {
    for (int x = 0; x < depth_m.cols; x += 2) {
      const float z = static_cast<float>(frame.depth.at<std::uint16_t>(y, x)) * frame.meters_per_unit;
      if (z > 0 && depth_m(y, x) > 0) differences.push_back(std::abs(z - depth_m(y, x)));
    }
  }
  if (differences.size() < kFewest) return std::nullopt;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::ranges::nth_element(differences, middle);
  return *middle;
}

class Nyu2Run {
 public:
  Nyu2Run(const NyuLabeledFile& labeled, Nyu2Videos& videos, ComputeContext& compute,
          const ScanParams& params, std::vector<int> lengths, std::optional<Nyu2Results>& results)
      : labeled_(labeled),
        videos_(videos),
        compute_(compute),
        params_(params),
        lengths_(std::move(lengths)),
        results_(results) {}

  Result<Nyu2Report> run(int every) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < labeled_.origins().size(); i += static_cast<std::size_t>(every))
      chosen.push_back(i);
    report_.labeled_images = static_cast<int>(chosen.size());
    for (const std::size_t image : chosen) {
      if (stopRequested()) break;
      ++position_;
      if (const auto done = judge(image); !done) return fail(done.error());
    }
    report_.is_complete = !stopRequested();
    report_.curve = nyu2Curve(images_, lengths_);
    return report_;
  }

 private:
  bool hasAll(const Nyu2Image& outcomes) const {
    return std::ranges::all_of(lengths_, [&](int n) { return outcomes.contains(n); });
  }

  Result<void> judge(std::size_t image) {
    Nyu2Image outcomes = results_ ? results_->of(image) : Nyu2Image();
    if (hasAll(outcomes)) {
      images_.push_back(std::move(outcomes));
      return {};
    }
    const NyuOrigin& origin = labeled_.origins()[image];
    if (!videos_.hasScene(origin)) {
      ++report_.without_scene;
      return {};
    }
    const auto clip = videos_.read(origin, lengths_.back());
    if (!clip) return leaveOut(clip.error());
    const auto truth = truthOf(image, clip->frames.back());
    if (!truth) return fail(truth.error());
    for (const std::string& message : clip->skipped) progress_.print(message);
    bool has_depth = true;
    SCANTROVE_TRY(scanAll(*clip, *truth, outcomes, has_depth));
    if (stopRequested()) return {};
    if (!has_depth)
      return leaveOut(
          {"The labelled frame " + origin.depth_file + " has too little depth to be scanned.", {}});
    images_.push_back(outcomes);
    return results_ ? results_->store(image, outcomes) : Result<void>();
  }

  Result<void> leaveOut(const Error& error) {
    ++report_.unusable;
    progress_.print(error.message());
    return {};
  }

  Result<void> scanAll(const Nyu2Clip& clip, const cv::Mat1i& truth, Nyu2Image& outcomes, bool& has_depth) {
    for (const int n : lengths_) {  // 1 is the first
      if (outcomes.contains(n)) continue;
      progress_.show([&] {
        return "image " + std::to_string(position_) + " of " + std::to_string(report_.labeled_images) + ", " +
               std::to_string(n) + (n == 1 ? " frame" : " frames");
      });
      const std::span<const RgbdFrame> frames(clip.frames);
      const auto outcome = scanNyu2Clip(compute_, params_, clip.K,
                                        frames.last(std::min(frames.size(), static_cast<std::size_t>(n))),
                                        truth, stopRequested);
      if (!outcome) return fail(outcome.error());
      if (stopRequested()) return {};
      has_depth = n > 1 || outcome->has_value();
      if (!has_depth) return {};
      outcomes[n] = outcome->value_or(Nyu2Outcome());
      if (outcome->has_value()) continue;
      outcomes[n] = outcomes.at(1);
      outcomes[n].is_lost = true;
    }
    return {};
  }

  Result<cv::Mat1i> truthOf(std::size_t image, const RgbdFrame& frame) {
    constexpr double kFarOff_m = 0.1;
    const auto labels = labeled_.labels(image);
    if (!labels) return fail(labels.error());
    const auto instances = labeled_.instances(image);
    if (!instances) return fail(instances.error());
    const auto depth = labeled_.depth(image);
    if (!depth) return fail(depth.error());
    if (labels->size() != frame.depth.size()) {
      return fail("The labelled images have another size than the raw depth images.",
                  "Give the labelled file and the raw data of the same data set.");
    }
    const auto difference = medianDifference(frame, *depth);
    if (difference && *difference > kFarOff_m) {
      progress_.print("The raw depth of " + labeled_.origins()[image].depth_file +
                      " differs from that of the labelled file by " + std::to_string(*difference) +
                      " m (median). Check that both are of the same data set.");
    }
    return nyuInstances(*labels, *instances);
  }

  const NyuLabeledFile& labeled_;
  Nyu2Videos& videos_;
  ComputeContext& compute_;
  const ScanParams& params_;
  std::vector<int> lengths_;
  std::optional<Nyu2Results>& results_;
  ProgressLine progress_;
  int position_ = 0;
  std::vector<Nyu2Image> images_;
  Nyu2Report report_;
};

Error nothingEvaluated(const Nyu2Evaluation& request, const Nyu2Report& report) {
  if (!report.is_complete) return {"Stopped before the first image was evaluated.", {}};
  const std::string all = std::to_string(report.labeled_images);
  if (report.without_scene == report.labeled_images) {
    return {"None of the " + all + " labelled images has its scene in " + request.raw + ".",
            "Give the folder with the scenes of the raw data set (bedroom_0001, ...), or one that holds its "
            "parts."};
  }
  return {"None of the " + all + " labelled images could be evaluated: " +
              std::to_string(report.without_scene) + " without a scene in " + request.raw + ", " +
              std::to_string(report.unusable) + " without a usable frame.",
          "The messages above say why."};
}

Result<void> writeResults(Nyu2Results& results, const Nyu2Report& report) {
  SCANTROVE_TRY(results.write("table-4.1.txt", nyu2Table(report.curve)));
  SCANTROVE_TRY(results.write("figure-4.9.csv", nyu2Csv(report.curve)));
  return results.write("figure-4.9.png", encodePng(drawNyu2Curve(report.curve)));
}

}  // namespace

Result<Nyu2Report> evaluateNyu2(const Nyu2Evaluation& request) {
  const KernelCacheUse kernels;
  ScanParams params;
  for (const std::string& setting : request.settings) SCANTROVE_TRY(applySetting(params, setting));
  const auto labeled = NyuLabeledFile::open(request.labeled);
  if (!labeled) return fail(labeled.error());
  auto videos = Nyu2Videos::open(request.raw);
  if (!videos) return fail(videos.error());
  const auto compute = ComputeContext::create({.device = request.device});
  if (!compute) return fail(compute.error());
  std::optional<Nyu2Results> results;
  if (!request.output.empty()) {
    auto opened =
        Nyu2Results::open(request.output, setupOf(*labeled, request, params, (*compute)->deviceName()));
    if (!opened) return fail(opened.error());
    results = std::move(*opened);
  }
  listenForStop();
  setAtStop(AtStop::unfinished);
  const auto report =
      Nyu2Run(*labeled, *videos, **compute, params, lengthsOf(request), results).run(request.every);
  if (!report) return fail(report.error());
  if (report->curve.empty()) return fail(nothingEvaluated(request, *report));
  if (results) SCANTROVE_TRY(writeResults(*results, *report));
  return report;
}

}  // namespace scantrove
