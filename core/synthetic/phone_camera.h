#pragma once
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove::synthetic {

/// What a telephone with a LiDAR sensor does differently from a depth camera of fixed focus: its focal length
/// follows the autofocus, it stores fewer colour images than depth images, and tells the confidence of each
/// reading.
struct PhoneCamera {
  /// Largest change of the focal length, as a part of it; 0: fixed.
  double breathing = 0;
  /// Of each `cycle` frames in turn the first `colored` have a colour image.
  int colored = 1, cycle = 1;
  /// Readings have a confidence, and those of low confidence are wrong.
  bool has_confidence = false;

  [[nodiscard]] bool hasColor(int frame) const { return frame % cycle < colored; }
  /// The camera at that time: one swing of the focal length takes 4 s.
  [[nodiscard]] Intrinsics intrinsicsAt(double time_s, const Intrinsics& K) const;
};

/// Confidences of the readings, as RgbdFrame::confidence: low within two pixels of a depth step, medium
/// within four. Readings of low confidence move to the middle of the step, where no surface is. `z_m`:
/// CV_32FC1, metres, 0 = none (low).
[[nodiscard]] cv::Mat blurSteps(cv::Mat& z_m);

}  // namespace scantrove::synthetic
