#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// A depth image and where it was taken, on the host.
struct DepthView {
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  cv::Mat z_m;  ///< CV_32FC1, height x width, metres along the optical axis, 0 = no reading
};

/// So far apart two depths contradict each other, whatever noise, edges, slant and poses do: metres, for a
/// reading at `z_m`. `depth_noise_m`: FusionParams.
[[nodiscard]] inline float contradiction_m(float z_m, float depth_noise_m) {
  constexpr float kAnyway_m = 0.05F;
  constexpr float kInNoise = 6;  // standard deviations
  return kAnyway_m + kInNoise * depth_noise_m * z_m * z_m;
}

}  // namespace scantrove
