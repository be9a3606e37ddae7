#pragma once
#include <opencv2/core/mat.hpp>
#include <span>

#include "core/evaluation/nyu2.h"

namespace scantrove {

/// The curve of thesis fig. 4.9 as a picture, CV_8UC3, BGR, 960 x 640: error 4.1 over the number of frames,
/// of the merged regions and of the last frame's own segments. `curve`: at least one point, frames ascending.
[[nodiscard]] cv::Mat drawNyu2Curve(std::span<const Nyu2Point> curve);

/// Where drawNyu2Curve() puts a point, for a curve from `first` to `last` frames and errors from `low` to
/// `high`.
struct Nyu2Axes {
  double first = 0, last = 1;
  double low = 0, high = 1;
  [[nodiscard]] cv::Point at(double frames, double error) const;
};

/// Axes that hold the curve, with round numbers at the ends of the errors.
[[nodiscard]] Nyu2Axes nyu2Axes(std::span<const Nyu2Point> curve);

}  // namespace scantrove
