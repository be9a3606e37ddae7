#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scantrove {

// The benchmark of the thesis (4.1): labelled images of NYUv2, each after a scan of n frames of its video.

/// The longest scan of thesis fig. 4.9, and that of table 4.1.
inline constexpr int kNyu2LongestScan = 20;
inline constexpr int kNyu2TableScan = 8;
/// More frames of a video than this are not scanned: all of a clip are in memory.
inline constexpr int kNyu2MostFrames = 300;

/// True instances: one number from 1 on for each pair of class and instance, in order of the pairs; 0: class
/// 0, not labelled. `labels` and `instances`: of one size.
[[nodiscard]] cv::Mat1i nyuInstances(const cv::Mat1w& labels, const cv::Mat1w& instances);

/// Boundary error of a segmentation, in pixels; lower is better.
struct Nyu2Error {
  double all = 0;        ///< thesis eq. 4.1: mean over all pixels
  double annotated = 0;  ///< mean over the labelled pixels
};

/// `segmentation`: any ids, 0 = none; of the size of `truth`.
[[nodiscard]] Nyu2Error nyu2Error(const cv::Mat1i& segmentation, const cv::Mat1i& truth);

/// One labelled image after a scan of n frames that ends with it.
struct Nyu2Outcome {
  Nyu2Error single;      ///< segments of the last frame, on the surface fused from n frames
  Nyu2Error merged;      ///< regions merged over n frames, seen from the last one
  bool is_lost = false;  ///< tracking lost the last frame: errors are those of n = 1
};

/// The outcomes of one labelled image by n.
using Nyu2Image = std::map<int, Nyu2Outcome>;

/// A point of the curve of thesis fig. 4.9: means over all images that have every n.
struct Nyu2Point {
  int frames = 0;  ///< n
  int images = 0;
  int lost = 0;  ///< images that tracking lost
  Nyu2Error single, merged;
};

/// The curve for `lengths` (ascending). Images without one of them are left out, so that all points show the
/// same images; empty if none is left.
[[nodiscard]] std::vector<Nyu2Point> nyu2Curve(std::span<const Nyu2Image> images,
                                               std::span<const int> lengths);

/// Table 4.1 as text: the errors of the thesis and those of the curve at n = 1 and n = kNyu2TableScan. Empty
/// if the curve has no point at one of them.
[[nodiscard]] std::string nyu2Table(std::span<const Nyu2Point> curve);

/// The curve as CSV, with a line of column names.
[[nodiscard]] std::string nyu2Csv(std::span<const Nyu2Point> curve);

}  // namespace scantrove
