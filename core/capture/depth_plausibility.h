#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Median of the valid depths of an image (CV_16UC1 or CV_32FC1, 0 = none), metres; empty if none is valid.
[[nodiscard]] std::optional<double> medianDepth(const cv::Mat& depth, double meters_per_unit);

/// A depth scale under which the depths of a recording are not those of a room. A wrong scale is the
/// commonest mistake with recordings.
struct ImplausibleDepth {
  double units_per_meter = 0;
  double median_m = 0;  ///< of the first frame
  /// A usual scale that makes the median plausible; none: no usual scale does.
  std::optional<double> proposed_units_per_meter;

  /// The median with the proposed scale.
  [[nodiscard]] double proposedMedian_m() const;
};

/// Judges the first frame (CV_16UC1 or CV_32FC1, 0 = none). Empty: its median lies within 0.2 - 8 m, or it
/// has no readings.
[[nodiscard]] std::optional<ImplausibleDepth> judgeDepth(const cv::Mat& depth, double units_per_meter);

/// Sentences for the user: the median, and the ready option `--depth-scale`.
[[nodiscard]] Error describe(const ImplausibleDepth& implausible, const std::string& source_name);

/// Judges the first frame and logs a warning with describe().
std::optional<ImplausibleDepth> warnOfImplausibleDepth(const cv::Mat& depth, double units_per_meter,
                                                       const std::string& source_name);

}  // namespace scantrove
