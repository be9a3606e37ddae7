#include "core/evaluation/segmentation_metrics.h"

#include "core/evaluation/boundary_error.h"
#include "core/evaluation/label_grid.h"
#include "core/evaluation/overlap_metrics.h"

namespace scantrove {

SegmentationMetrics evaluateSegmentation(const cv::Mat& segmentation, const cv::Mat& truth,
                                         const SegmentationMetricOptions& options) {
  constexpr double kPartShare = 0.1;
  const cv::Mat1i segments = toLabelGrid(segmentation);
  const cv::Mat1i instances = toLabelGrid(truth);
  const cv::Mat1b segment_boundary = boundaryPixels(segments);
  const cv::Mat1b truth_boundary = boundaryPixels(instances);

  SegmentationMetrics metrics;
  metrics.boundary_error = boundaryError(segment_boundary, truth_boundary);
  metrics.boundary_precision = boundaryShareNear(segment_boundary, truth_boundary, options.tolerance_px);
  metrics.boundary_recall = boundaryShareNear(truth_boundary, segment_boundary, options.tolerance_px);
  const double sum = metrics.boundary_precision + metrics.boundary_recall;
  metrics.boundary_f = sum > 0 ? 2 * metrics.boundary_precision * metrics.boundary_recall / sum : 0;

  const OverlapTable table = countOverlaps(segments, instances, options.min_instance_px);
  const Coverage covered = coverage(table);
  metrics.coverage_weighted = covered.weighted;
  metrics.coverage = covered.unweighted;
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
  if (with_instances > 0) {
    mean.coverage_weighted /= with_instances;
    mean.coverage /= with_instances;
  }
  return mean;
}

}  // namespace scantrove
