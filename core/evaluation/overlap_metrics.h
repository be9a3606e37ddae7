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

/// A segment's area includes pixels of true label 0, so that leaking into the background is penalised.
[[nodiscard]] OverlapTable countOverlaps(const cv::Mat1i& segmentation, const cv::Mat1i& truth,
                                         int min_instance_px);

struct Coverage {
  double weighted = 0;  ///< by instance area
  double unweighted = 0;
};

/// Mean over true instances of the best intersection over union with any segment (0 where none touches it).
[[nodiscard]] Coverage coverage(const OverlapTable& table);

/// Detection of instances in one size range.
struct SizedCoverage {
  int instances = 0;
  double coverage = 0;   ///< mean of the best intersection over union
  double over_half = 0;  ///< share of the instances with IoU > 0.5 to one segment
};

/// For instances with an area of `least` to `most` pixels, both included.
[[nodiscard]] SizedCoverage coverageOfSize(const OverlapTable& table, double least, double most);

/// Number of instances of which at least two segments each hold `share` or more of the area.
[[nodiscard]] int overSegmentedCount(const OverlapTable& table, double share);

/// Number of segments that hold `share` or more of the area of each of at least two instances.
[[nodiscard]] int underSegmentedCount(const OverlapTable& table, double share);

}  // namespace scantrove
