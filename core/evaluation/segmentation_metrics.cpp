#include "core/evaluation/segmentation_metrics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/capture/intrinsics.h"
#include "core/evaluation/boundary_error.h"
#include "core/evaluation/label_grid.h"

namespace scantrove {
namespace {

constexpr double kSmall_px = 400;
constexpr double kLarge_px = 15000;

/// Adds the sums of one image; means are computed at the end.
void addSums(SizedCoverage& sum, const SizedCoverage& image) {
  sum.instances += image.instances;
  sum.coverage += image.coverage * image.instances;
  sum.over_half += image.over_half * image.instances;
}

}  // namespace

SegmentationMetrics evaluateSegmentation(const cv::Mat& segmentation, const cv::Mat& truth,
                                         const SegmentationMetricOptions& options) {
  constexpr double kPartShare = 0.1;
  const cv::Mat1i segments = toLabelGrid(segmentation);
  const cv::Mat1i instances = toLabelGrid(truth);
  const cv::Mat1b segment_boundary = boundaryPixels(segments);
  const cv::Mat1b truth_boundary = boundaryPixels(instances);

  SegmentationMetrics metrics;
  cv::Mat1b annotated;
  cv::compare(instances, 0, annotated, cv::CMP_NE);
  cv::Mat1b judged_boundary;
  cv::bitwise_and(segment_boundary, annotated, judged_boundary);
  metrics.boundary_error = boundaryError(segment_boundary, truth_boundary, annotated);
  metrics.boundary_precision = boundaryShareNear(judged_boundary, truth_boundary, options.tolerance_px);
  metrics.boundary_recall = boundaryShareNear(truth_boundary, segment_boundary, options.tolerance_px);
  const double sum = metrics.boundary_precision + metrics.boundary_recall;
  metrics.boundary_f = sum > 0 ? 2 * metrics.boundary_precision * metrics.boundary_recall / sum : 0;

  const OverlapTable table = countOverlaps(segments, instances, options.min_instance_px);
  const Coverage covered = coverage(table);
  metrics.coverage_weighted = covered.weighted;
  metrics.coverage = covered.unweighted;
  const double scale = static_cast<double>(instances.total()) / kReferencePixels;
  metrics.small = coverageOfSize(table, kSmall_px * scale, kLarge_px * scale);
  metrics.large = coverageOfSize(table, std::nextafter(kLarge_px * scale, HUGE_VAL), HUGE_VAL);
  metrics.instances = static_cast<int>(table.instance_area.size());
  metrics.over_segmented = overSegmentedCount(table, kPartShare);
  metrics.under_segmented = underSegmentedCount(table, kPartShare);
  return metrics;
}

SegmentationMetrics averaged(const std::vector<SegmentationMetrics>& images) {
  SegmentationMetrics mean;
  if (images.empty()) return mean;
  double with_instances = 0;
  for (const SegmentationMetrics& image : images) {
    mean.boundary_error += image.boundary_error;
    mean.boundary_precision += image.boundary_precision;
    mean.boundary_recall += image.boundary_recall;
    mean.boundary_f += image.boundary_f;
    mean.instances += image.instances;
    mean.over_segmented += image.over_segmented;
    mean.under_segmented += image.under_segmented;
    addSums(mean.small, image.small);
    addSums(mean.large, image.large);
    if (image.instances == 0) continue;
    mean.coverage_weighted += image.coverage_weighted;
    mean.coverage += image.coverage;
    ++with_instances;
  }
  const double count = static_cast<double>(images.size());
  for (double* value :
       {&mean.boundary_error, &mean.boundary_precision, &mean.boundary_recall, &mean.boundary_f}) {
    *value /= count;
  }
  for (SizedCoverage* sized : {&mean.small, &mean.large}) {
    sized->coverage /= std::max(sized->instances, 1);
    sized->over_half /= std::max(sized->instances, 1);
  }
  if (with_instances > 0) {
    mean.coverage_weighted /= with_instances;
    mean.coverage /= with_instances;
  }
  return mean;
}

}  // namespace scantrove
