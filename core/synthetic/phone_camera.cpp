#include "core/synthetic/phone_camera.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/capture/rgbd_frame.h"

namespace scantrove::synthetic {
namespace {

constexpr double kSwing_s = 4;
/// Readings on both sides of a step differ by more than this part of the nearer one.
constexpr double kStep = 0.05;
constexpr int kLowReach_px = 2, kMediumReach_px = 4;

/// Nearest and farthest reading around each pixel.
struct Surroundings {
  cv::Mat near_m, far_m;  ///< FLT_MAX and 0 without readings

  Surroundings(const cv::Mat& z_m, int reach_px) {
    const cv::Mat square = cv::Mat::ones(2 * reach_px + 1, 2 * reach_px + 1, CV_8UC1);
    cv::Mat readings = z_m.clone();
    readings.setTo(std::numeric_limits<float>::max(), z_m <= 0);
    cv::erode(readings, near_m, square);
    cv::dilate(z_m, far_m, square);
  }
  [[nodiscard]] cv::Mat isStep() const { return far_m > (1 + kStep) * near_m; }
};

}  // namespace

Intrinsics PhoneCamera::intrinsicsAt(double time_s, const Intrinsics& K) const {
  const auto scale = static_cast<float>(1 + breathing * std::sin(2 * std::numbers::pi * time_s / kSwing_s));
  return {K.fx * scale, K.fy * scale, K.cx, K.cy, K.width, K.height};
}

cv::Mat blurSteps(cv::Mat& z_m) {
  const Surroundings close(z_m, kLowReach_px), wide(z_m, kMediumReach_px);
  cv::Mat confidence(z_m.size(), CV_8UC1, cv::Scalar(kHighConfidence));
  confidence.setTo(kMediumConfidence, wide.isStep());
  cv::Mat is_wrong = close.isStep();
  is_wrong.setTo(0, z_m <= 0);
  confidence.setTo(kLowConfidence, is_wrong);
  confidence.setTo(kLowConfidence, z_m <= 0);
  const cv::Mat middle_m = 0.5 * close.near_m + 0.5 * close.far_m;
  middle_m.copyTo(z_m, is_wrong);
  return confidence;
}

}  // namespace scantrove::synthetic
