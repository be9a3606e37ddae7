#pragma once
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// How a lens bends what a pinhole camera would see (Brown 1966; OpenCV's order k1, k2, p1, p2, k3).
struct LensDistortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
};

/// Makes images of a lens those of the pinhole camera `K` that it is near. Any thread.
class Undistorter {
 public:
  Undistorter(const LensDistortion& lens, const Intrinsics& K);

  /// Of K's size, any type; smooth.
  [[nodiscard]] cv::Mat ofColor(const cv::Mat& image) const;
  /// The same without mixing neighbours; 0 where the lens saw nothing.
  [[nodiscard]] cv::Mat ofDepth(const cv::Mat& depth) const;

 private:
  cv::Mat places_;  // CV_16SC2 and CV_16UC1, where each pixel comes from
  cv::Mat fractions_;
};

}  // namespace scantrove
