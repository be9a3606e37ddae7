#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove::synthetic {

/// Noise model of a structured-light camera like the first Kinect. Axial noise: Nguyen, Izadi and Lovell
/// 2012, equation 3 at small angles; disparity steps of an eighth of a pixel: Khoshelham and Elberink 2012.
struct KinectModel {
  double sigma_offset_m = 0.0012;  ///< sigma(z) = offset + slope * (z - 0.4)^2
  double sigma_slope = 0.0019;
  double lateral_sigma_px = 0.6;  ///< displacement of edges
  double baseline_m = 0.075;      ///< the projector is this far to the camera's right (+x)
  double focal_px = 585;          ///< of the infrared camera, for the disparity
  double disparity_step_px = 0.125;
  double edge_dropout = 0.35;  ///< probability of no reading for a pixel next to a depth edge
  double grazing_cosine =
      0.26;  ///< cosine of incidence below which readings begin to fail; none remain at a third of it
  double min_depth_m = 0.40;  ///< no readings nearer than this
  double max_depth_m = 8.0;

  [[nodiscard]] double sigma(double z) const { return sigma_offset_m + sigma_slope * (z - 0.4) * (z - 0.4); }
};

/// Projector shadow: 255 where its light does not arrive, to the left of near things. `z_m` CV_32FC1; result
/// CV_8UC1.
[[nodiscard]] cv::Mat projectorShadow(const cv::Mat& z_m, const Intrinsics& K, const KinectModel& model);

/// Measured depth, CV_32FC1 metres, 0 = no reading, from true depth and cosine of incidence (both CV_32FC1).
/// Deterministic: the same seed and frame give the same noise.
[[nodiscard]] cv::Mat measureDepth(const cv::Mat& z_m, const cv::Mat& incidence, const Intrinsics& K,
                                   const KinectModel& model, std::uint32_t seed, std::uint32_t frame);

/// Adds independent Gaussian noise of `sigma` grey levels to each byte of a CV_8UC3 image.
void addColorNoise(cv::Mat& color, double sigma, std::uint32_t seed, std::uint32_t frame);

}  // namespace scantrove::synthetic
