#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// A depth image with its camera and pose, on the host.
struct DepthView {
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  cv::Mat z_m;  ///< CV_32FC1, height x width, metres along the optical axis, 0 = no reading
};

/// Distance in metres from which two depths contradict each other despite noise, edges, slant and pose
/// errors, for a reading at `z_m`. `depth_noise_m`: FusionParams.
struct DepthContradiction {
  float anyway_m;
  [[nodiscard]] float at(float z_m, float depth_noise_m) const {
    constexpr float kInNoise = 6;  // standard deviations
    return anyway_m + kInNoise * depth_noise_m * z_m * z_m;
  }
};
/// For a reading in front of a surface.
inline constexpr DepthContradiction kBefore{0.05F};
/// For a reading behind one. Smaller, because a mug taken from a table uncovers surface a few centimetres
/// behind it.
inline constexpr DepthContradiction kBehind{0.025F};

}  // namespace scantrove
