#include "app/frame_use.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "app/stop_signal.h"
#include "core/capture/depth_plausibility.h"
#include "core/scan/open_source.h"

namespace scantrove {
namespace {

/// Depth statistics of the first frames of a recording.
struct DepthSample {
  int images = 0;
  std::vector<double> medians_m;  ///< of the images with readings
};

DepthSample sampleDepth(const std::string& source, SourceOptions options) {
  constexpr int kSampled = 10;
  options.frames = std::min(options.frames.value_or(kSampled), kSampled);
  DepthSample sample;
  const auto opened = openSource(source, options);
  if (!opened || (*opened)->info().is_live) return sample;
  while (true) {
    const FrameRead read = (*opened)->next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return sample;
    if (read.status != FrameRead::Status::frame) continue;
    ++sample.images;
    if (const auto median = medianDepth(read.frame.depth, read.frame.meters_per_unit)) {
      sample.medians_m.push_back(*median);
    }
  }
}

std::string meters(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value << " m";
  return text.str();
}

Error likelyReason(const ScanReport& report, const SourceOptions& options, bool is_resumed) {
  const FusionParams& fusion = report.params.fusion;
  const std::string range = meters(fusion.min_depth_m) + " to " + meters(fusion.max_depth_m);
  DepthSample sample = sampleDepth(report.source, options);
  if (sample.images > 0 && sample.medians_m.empty()) {
    return {"its depth images hold no readings (all 0 or 65535)",
            "Check that depth was recorded and that this is the depth folder."};
  }
  if (!sample.medians_m.empty()) {
    std::ranges::nth_element(sample.medians_m, sample.medians_m.begin() + sample.medians_m.size() / 2);
    const double median_m = sample.medians_m[sample.medians_m.size() / 2];
    if (median_m < fusion.min_depth_m || median_m > fusion.max_depth_m) {
      return {"its median depth is " + meters(median_m) + ", but only depths from " + range + " are used",
              "Give the right --depth-scale (units per metre: 1000 for millimetres, 5000 for TUM), or other "
              "limits with --set fusion.min_depth_m=... and fusion.max_depth_m=..."};
    }
  }
  if (is_resumed && report.map_bricks > 0) {
    return {"no frame matches the map of the earlier scan",
            "Start at a place that it has seen, or scan into a new folder with --out."};
  }
  return {"too few pixels have a depth from " + range, "Point the camera at surfaces in this range."};
}

}  // namespace

Result<void> checkFramesWereUsed(const ScanReport& report, const SourceOptions& options, bool is_resumed) {
  if (report.frames.tracked > 0 && report.map_bricks > 0) return {};
  if (report.frames.read == 0 && stopRequested()) return {};
  if (report.frames.read == 0) {
    return fail("No frame could be used: all " + std::to_string(report.frames.skipped) + " of " +
                    report.source + " were unreadable.",
                "Check the recording, --start and --stride.");
  }
  const Error reason = likelyReason(report, options, is_resumed);
  return fail("No frame could be used: " + report.source + ": " + reason.what + ".", reason.advice);
}

}  // namespace scantrove
