#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The distance in the image between a frame's depth edges and its colour edges. Unit: pixels of an image
/// that is 640 wide.
class DepthShift {
 public:
  /// `depth`: CV_16UC1 of the size of K_depth; `color`: CV_8UC3 of the size of K_color.
  DepthShift(const KeyFrameInfo& frame, const cv::Mat& depth, const cv::Mat& color);

  /// The shift at which most of the depth edges, seen from the colour camera, lie on colour edges; less than
  /// 20 in each direction. None: too few depth edges, an image under 320 pixels wide, or no clear result.
  [[nodiscard]] std::optional<cv::Point2f> best() const;
  /// Whether that shift is clearly better than `other` and those beside it.
  [[nodiscard]] bool isBetterThan(const cv::Point2f& other) const;

 private:
  float stride_ = 1;  // of the shifts
  cv::Mat fits_;      // CV_32FC1, by shift: mean strength of colour edges; empty: too few depth edges
};

}  // namespace scantrove
