#include "app/image_evaluation.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/json_output.h"
#include "core/capture/image_pairs.h"
#include "core/evaluation/label_grid.h"
#include "core/evaluation/overlap_metrics.h"
#include "core/exchange/label_image_writer.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/segmentation/upsample_segments.h"
#include "core/session/param_registry.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// Instances with more pixels at 640 x 480 are large: a third of those on a table seen from above.
constexpr double kLarge_px = 2500;

/// Regions of one frame at the resolution of its depth image.
std::vector<RegionId> regionsOf(const FrameResult& result, const RgbdFrame& frame) {
  const DepthUpsampler upsampler(result.segments.depths_m, result.segments.width, result.segments.height,
                                 {frame.depth.cols,
                                  frame.depth.rows,
                                  {frame.depth.ptr<std::uint16_t>(), frame.depth.total()},
                                  frame.meters_per_unit});
  return upsampler.apply(result.view.regions);
}

/// True instances as numbers; 0: none.
cv::Mat1i instancesOf(const cv::Mat& labels) {
  constexpr int kParts = 10;       // of mOSD: LABEL = 10 * instance + part
  constexpr int kFirstObject = 2;  // instance 0: none, and 0.1 .. 0.9: parts of the table
  double most = 0;
  cv::minMaxLoc(labels, nullptr, &most);
  cv::Mat1i instances;
  labels.convertTo(instances, CV_32S);
  if (most >= kParts * kParts) return instances;
  for (int& label : instances) label = label / kParts < kFirstObject ? 0 : label / kParts;
  return instances;
}

Json toJson(const SizedCoverage& sized) {
  return {{"instances", sized.instances}, {"coverage", sized.coverage}, {"over_half", sized.over_half}};
}

/// Sums over images, where each instance has equal weight.
class Totals {
 public:
  void add(const SizedCoverage& image) {
    total_.instances += image.instances;
    total_.coverage += image.instances * image.coverage;
    total_.over_half += image.instances * image.over_half;
  }
  [[nodiscard]] SizedCoverage mean() const {
    SizedCoverage mean = total_;
    if (mean.instances == 0) return mean;
    mean.coverage /= mean.instances;
    mean.over_half /= mean.instances;
    return mean;
  }

 private:
  SizedCoverage total_;
};

class ImageJudge {
 public:
  ImageJudge(const ImageEvaluation& request, const ScanParams& params, ComputeContext& compute)
      : request_(request), params_(params), compute_(compute) {}

  Result<void> judge(const std::string& name, const RgbdFrame& frame, const Intrinsics& K) {
    const fs::path folder = request_.folder;
    const Result<cv::Mat> truth = readLabelImage(folder / (name + "-label.png"));
    if (!truth) return fail(truth.error());
    if (truth->size() != frame.depth.size()) {
      return fail((folder / (name + "-label.png")).string() + " has another size than the depth image.",
                  "Give labels of the same size.");
    }
    auto pipeline = MappingPipeline::create(compute_, {K, params_});
    if (!pipeline) return fail(pipeline.error());
    const Result<FrameResult> result = (*pipeline)->processFrame(frame);
    if (!result) return fail(result.error());
    cv::Mat1i labels(frame.depth.size(), 0);
    if (result->pose.usable())
      std::ranges::transform(regionsOf(*result, frame), labels.begin(),
                             [](RegionId id) { return static_cast<int>(id.value); });
    if (!request_.output.empty()) SCANTROVE_TRY(write(name, labels));
    const cv::Mat1i instances = instancesOf(*truth);
    const OverlapTable table = countOverlaps(labels, instances, 1);
    const double large = kLarge_px * static_cast<double>(frame.depth.total()) / kReferencePixels;
    const double most = std::numeric_limits<double>::max();
    const SizedCoverage all = coverageOfSize(table, 0, most);
    all_.add(all);
    small_.add(coverageOfSize(table, 0, large));
    large_.add(coverageOfSize(table, large + 1, most));
    Json image = {{"name", name}};
    image.update(toJson(all));
    images_.push_back(std::move(image));
    return {};
  }

  [[nodiscard]] Json json() const {
    Json json = {{"images", images_.size()}};
    json.update(toJson(all_.mean()));
    json["small"] = toJson(small_.mean());
    json["large"] = toJson(large_.mean());
    json["each"] = images_;
    return json;
  }

 private:
  [[nodiscard]] Result<void> write(const std::string& name, const cv::Mat1i& labels) const {
    const fs::path file = fs::path(request_.output) / (name + "-labels.png");
    std::error_code ignored;
    if (fs::exists(file, ignored))
      return fail(file.string() + " exists already.", "Give another folder with --out.");
    std::vector<std::uint32_t> ids(labels.begin(), labels.end());
    return writeLabelImage(file, ids, labels.size());
  }

  const ImageEvaluation& request_;
  ScanParams params_;
  ComputeContext& compute_;
  Totals all_, small_, large_;
  std::vector<Json> images_;
};

}  // namespace

Result<Json> evaluateImages(const ImageEvaluation& request) {
  ScanParams params;
  for (const std::string& setting : request.settings) SCANTROVE_TRY(applySetting(params, setting));
  auto pairs = openImagePairs(request.folder);
  if (!pairs) return fail(pairs.error());
  std::error_code failure;
  if (!request.output.empty()) fs::create_directories(request.output, failure);
  if (failure)
    return fail("The folder " + request.output + " cannot be created: " + failure.message() + ".",
                "Give another one with --out.");
  const auto compute = ComputeContext::create({.device = request.device});
  if (!compute) return fail(compute.error());
  ImageJudge judge(request, params, **compute);
  for (FrameRead read = pairs->frames->next(); read.status != FrameRead::Status::end;
       read = pairs->frames->next()) {
    if (read.status != FrameRead::Status::frame) return fail(read.error);
    const auto index = static_cast<std::size_t>(read.frame.index);
    SCANTROVE_TRY(judge.judge(pairs->names[index], read.frame, pairs->frames->info().intrinsics));
  }
  return judge.json();
}

}  // namespace scantrove
