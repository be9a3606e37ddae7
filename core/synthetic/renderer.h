#pragma once
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"
#include "core/synthetic/lighting.h"
#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// Images of an ideal camera, all h x w.
struct RenderedFrame {
  cv::Mat color;      ///< CV_8UC3, BGR; empty unless requested
  cv::Mat z_m;        ///< CV_32FC1, depth along the optical axis, 0 = nothing there
  cv::Mat incidence;  ///< CV_32FC1, cosine between surface normal and ray, 0..1
  cv::Mat instances;  ///< CV_16UC1, 0 = nothing there
  cv::Mat parts;      ///< CV_32SC1, index into SyntheticScene::parts(), -1 = nothing there
};

/// Rays go through pixel centres. Without `lighting` there is no colour. Any thread.
[[nodiscard]] RenderedFrame renderFrame(const SyntheticScene& scene, const Lighting* lighting,
                                        const Intrinsics& K, const Eigen::Isometry3d& T_world_camera);

}  // namespace scantrove::synthetic
