#include "app/segmentation_evaluation.h"

#include <array>
#include <iostream>
#include <optional>

#include "app/command.h"
#include "app/json_output.h"
#include "app/label_images.h"
#include "app/map_instances.h"
#include "core/evaluation/average_precision.h"
#include "core/exchange/label_image_writer.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kSeriesLength = 20;  // frames in thesis fig. 4.9

Json toJson(const SizedCoverage& sized) {
  return {{"instances", sized.instances}, {"coverage", sized.coverage}, {"over_half", sized.over_half}};
}

Json toJson(const SegmentationMetrics& metrics) {
  return {{"boundary_error", metrics.boundary_error},
          {"boundary_precision", metrics.boundary_precision},
          {"boundary_recall", metrics.boundary_recall},
          {"boundary_f", metrics.boundary_f},
          {"coverage_weighted", metrics.coverage_weighted},
          {"coverage", metrics.coverage},
          {"small", toJson(metrics.small)},
          {"large", toJson(metrics.large)},
          {"instances", metrics.instances},
          {"over_segmented", metrics.over_segmented},
          {"under_segmented", metrics.under_segmented}};
}

tl::unexpected<Error> nothingInCommon(const std::string& labels, const std::string& truth) {
  return fail("No label image of " + labels + " has the number of one in " + truth + ".",
              "Give two folders of PNGs named by frame, such as 000012.png.");
}

/// Kinds of label images of a frame.
enum Labels : std::size_t { kSingle, kMerged, kFinal, kKinds };
constexpr std::array<const char*, kKinds> kFolders{"segments", "labels", "labels-final"};
using FrameMetrics = std::array<SegmentationMetrics, kKinds>;

/// A frame with ground truth; `number` counts the frames that the scan merged, from 1.
struct JudgedFrame {
  std::size_t number = 0;
  FrameMetrics metrics;
};

Result<void> judgeScan(const JudgedScan& scan, const SegmentationMetricOptions& options,
                       std::vector<JudgedFrame>& frames) {
  const fs::path folder = scan.scan;
  for (const char* name : kFolders) {
    std::error_code ignored;
    if (fs::is_directory(folder / name, ignored)) continue;
    return fail("The scan " + scan.scan + " has no folder " + name + ".",
                "Run the complete scan with --label-maps.");
  }
  const auto merged_images = numberedImages(folder / kFolders[kMerged]);
  if (!merged_images) return fail(merged_images.error());
  const auto truths = numberedImages(scan.truth);
  if (!truths) return fail(truths.error());
  const std::size_t before = frames.size();
  std::size_t merged_count = 0;
  for (const auto& [number, image] : *merged_images) {
    ++merged_count;
    const auto match = truths->find(number);
    if (match == truths->end()) continue;
    const auto truth = readLabelImage(match->second);
    if (!truth) return fail(truth.error());
    JudgedFrame frame{merged_count, {}};
    for (const Labels kind : {kSingle, kMerged, kFinal}) {
      const auto metrics = evaluateLabelImage(folder / kFolders[kind] / image.filename(), *truth, options);
      if (!metrics) return fail(metrics.error());
      frame.metrics[kind] = *metrics;
    }
    frames.push_back(frame);
  }
  if (frames.size() == before) return nothingInCommon((folder / kFolders[kMerged]).string(), scan.truth);
  return {};
}

SegmentationMetrics meanOf(const std::vector<JudgedFrame>& frames, Labels kind) {
  std::vector<SegmentationMetrics> all;
  all.reserve(frames.size());
  for (const JudgedFrame& frame : frames) all.push_back(frame.metrics[kind]);
  return averaged(all);
}

/// Null without a value.
Json toJson(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json toJson(const AveragePrecision& precision) {
  return {{"ap", toJson(precision.ap)},
          {"ap50", toJson(precision.ap50)},
          {"ap25", toJson(precision.ap25)},
          {"instances", precision.instances},
          {"predictions", precision.predictions}};
}

/// Null unless every scan has a cloud and truth with depth.
Result<Json> averagePrecisionOf(const std::vector<JudgedScan>& scans) {
  std::vector<PointInstances> scenes;
  std::string unrated;
  for (const JudgedScan& scan : scans) {
    auto scene = readMapInstances(
        scan.scan, scan.truth, scan.with_estimated ? EstimatedPoints::included : EstimatedPoints::left_out);
    if (!scene) return fail(scene.error());
    if (!*scene) return Json();
    if ((*scene)->confidence.empty() && unrated.empty()) unrated = scan.scan;
    scenes.push_back(std::move(**scene));
  }
  if (!unrated.empty()) {
    // Ratings of one scan cannot be compared with sizes of another.
    for (PointInstances& scene : scenes) scene.confidence.clear();
    std::cerr
        << "scantrove: The scan " << inLine(unrated)
        << " has no objectness of its regions: average precision takes larger regions for more likely.\n";
  }
  Json json = toJson(averagePrecision(scenes));
  json["confidence"] = unrated.empty() ? "objectness" : "points";
  return json;
}

/// Null if `to` is 0.
Json ratio(double of, double to) { return to > 0 ? Json(of / to) : Json(); }

Json seriesOverFrames(const std::vector<JudgedFrame>& frames) {
  Json series = Json::array();
  for (std::size_t n = 1; n <= kSeriesLength; ++n) {
    std::vector<JudgedFrame> at_n;
    for (const JudgedFrame& frame : frames) {
      if (frame.number == n) at_n.push_back(frame);
    }
    if (at_n.empty()) continue;
    const SegmentationMetrics alone = meanOf(at_n, kSingle);
    const SegmentationMetrics together = meanOf(at_n, kMerged);
    series.push_back({{"n", n},
                      {"images", at_n.size()},
                      {"single", toJson(alone)},
                      {"merged", toJson(together)},
                      {"ratio", ratio(together.boundary_error, alone.boundary_error)}});
  }
  return series;
}

}  // namespace

Result<Json> evaluateEstimate(const std::string& estimate, const std::string& truth,
                              const SegmentationMetricOptions& options) {
  const auto estimates = numberedImages(estimate);
  if (!estimates) return fail(estimates.error());
  const auto truths = numberedImages(truth);
  if (!truths) return fail(truths.error());
  std::vector<SegmentationMetrics> all;
  Json images = Json::array();
  for (const auto& [number, path] : *estimates) {
    const auto match = truths->find(number);
    if (match == truths->end()) continue;
    const auto true_labels = readLabelImage(match->second);
    if (!true_labels) return fail(true_labels.error());
    const auto metrics = evaluateLabelImage(path, *true_labels, options);
    if (!metrics) return fail(metrics.error());
    all.push_back(*metrics);
    Json image = {{"image", path.filename().string()}};
    image.update(toJson(*metrics));
    images.push_back(std::move(image));
  }
  if (all.empty()) return nothingInCommon(estimate, truth);
  return Json{{"images", all.size()}, {"mean", toJson(averaged(all))}, {"each", images}};
}

Result<Json> evaluateScans(const std::vector<JudgedScan>& scans, const SegmentationMetricOptions& options) {
  std::vector<JudgedFrame> frames;
  for (const JudgedScan& scan : scans) SCANTROVE_TRY(judgeScan(scan, options, frames));
  const SegmentationMetrics alone = meanOf(frames, kSingle);
  const SegmentationMetrics together = meanOf(frames, kMerged);
  const SegmentationMetrics at_end = meanOf(frames, kFinal);
  const Result<Json> precision = averagePrecisionOf(scans);
  if (!precision) return fail(precision.error());
  Json json{{"images", frames.size()},
            {"single", toJson(alone)},
            {"merged", toJson(together)},
            {"final", toJson(at_end)},
            {"ratio", ratio(together.boundary_error, alone.boundary_error)},
            {"ratio_final", ratio(at_end.boundary_error, alone.boundary_error)}};
  if (!precision->is_null()) json["average_precision"] = *precision;
  json["over_frames"] = seriesOverFrames(frames);
  return json;
}

}  // namespace scantrove
