#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <utility>

namespace scantrove {

/// Areas in pixels of segments, true instances and their intersections. Label 0 of either image is left out.
struct OverlapTable {
  std::map<int, int> segment_area;
  std::map<int, int> instance_area;
  std::map<std::pair<int, int>, int> intersection;  ///< (instance, segment)
};

/// A segment's area counts all its pixels, also those on true label 0: a segment that leaks into the
/// background pays.
[[nodiscard]] OverlapTable countOverlaps(const cv::Mat1i& segmentation, const cv::Mat1i& truth,
                                         int min_instance_px);

struct Coverage {
  double weighted = 0;  ///< by instance area
  double unweighted = 0;
};

/// Mean over true instances of the best intersection over union with any segment (0 where none touches it).
[[nodiscard]] Coverage coverage(const OverlapTable& table);

/// How well instances of one size are found.
struct SizedCoverage {
  int instances = 0;
  double coverage = 0;   ///< mean of the best intersection over union
  double over_half = 0;  ///< share of the instances that one segment covers by more than half (IoU > 0.5)
};

/// Of the instances whose area is `least` to `most` pixels, both included.
[[nodiscard]] SizedCoverage coverageOfSize(const OverlapTable& table, double least, double most);

/// Instances of which at least two segments each hold `share` or more of the instance's area.
[[nodiscard]] int overSegmentedCount(const OverlapTable& table, double share);

/// Segments that hold `share` or more of the area of each of at least two instances.
[[nodiscard]] int underSegmentedCount(const OverlapTable& table, double share);

}  // namespace scantrove
