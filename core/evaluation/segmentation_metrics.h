#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/evaluation/overlap_metrics.h"

namespace scantrove {

/// Metrics of one segmented image against its ground truth (algorithms.md 5). Images of one size; 0 =
/// unlabelled.
struct SegmentationMetrics {
  double boundary_error = 0;      ///< thesis eq. 4.1 over annotated pixels, in pixels; lower is better
  double boundary_precision = 0;  ///< share of the segmentation's boundary, where truth is annotated, within
                                  ///< `tolerance_px` of the truth's
  double boundary_recall = 0;  ///< share of the truth's boundary within `tolerance_px` of the segmentation's
  double boundary_f = 0;       ///< harmonic mean of the two
  double coverage_weighted =
      0;                   ///< mean over true instances of the best intersection over union, weighted by area
  double coverage = 0;     ///< the same, unweighted
  SizedCoverage small;     ///< instances of 400 - 15,000 pixels at 640 x 480, scaled for other sizes
  SizedCoverage large;     ///< larger instances
  int instances = 0;       ///< true instances counted
  int over_segmented = 0;  ///< true instances of which two or more segments each hold a tenth
  int under_segmented = 0;  ///< segments that hold a tenth or more of each of two or more true instances
};

struct SegmentationMetricOptions {
  double tolerance_px = 2;  ///< for boundary precision and recall, Euclidean
  int min_instance_px = 1;  ///< smaller true instances are not counted
};

/// Types as in toLabelGrid. True label 0 is no instance; segment 0 is no segment.
[[nodiscard]] SegmentationMetrics evaluateSegmentation(const cv::Mat& segmentation, const cv::Mat& truth,
                                                       const SegmentationMetricOptions& options = {});

/// Mean over images; counts are summed. Coverages ignore images without a true instance. In `small` and
/// `large` every instance of every image has equal weight.
[[nodiscard]] SegmentationMetrics averaged(const std::vector<SegmentationMetrics>& images);

}  // namespace scantrove
