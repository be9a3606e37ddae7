#pragma once
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// Lens distortion of a pinhole image (Brown 1966, and OpenCV's rational model with a denominator; its order
/// k1, k2, p1, p2, k3, k4, k5, k6).
struct LensDistortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double k4 = 0, k5 = 0, k6 = 0;  ///< of the denominator
  /// The formula takes distorted to undistorted coordinates (RealSense's "Inverse Brown Conrady"), where it
  /// otherwise takes undistorted to distorted ones.
  bool is_inverse = false;

  /// Whether the lens is a pinhole.
  [[nodiscard]] bool isZero() const {
    return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0 && k4 == 0 && k5 == 0 && k6 == 0;
  }
};

/// Undistorts images to the pinhole camera `K`. Any thread.
class Undistorter {
 public:
  Undistorter(const LensDistortion& lens, const Intrinsics& K);

  /// Undistorts an image of K's size, any type, with interpolation.
  [[nodiscard]] cv::Mat ofColor(const cv::Mat& image) const;
  /// The same from the nearest pixel, without interpolation; 0 outside the lens's image.
  [[nodiscard]] cv::Mat ofDepth(const cv::Mat& depth) const;

 private:
  cv::Mat places_;  // CV_16SC2 and CV_16UC1, source position of each pixel
  cv::Mat fractions_;
  cv::Mat nearest_;  // CV_16SC2, the nearest pixel
};

}  // namespace scantrove
