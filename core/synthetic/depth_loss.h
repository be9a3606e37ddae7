#pragma once
#include <vector>

#include "core/synthetic/hard_camera.h"
#include "core/synthetic/renderer.h"

namespace scantrove::synthetic {

/// Light of the projector that returns from each pixel's surface and can be matched, CV_32FC1 0..1. 1: a matt
/// bright surface. Little returns from dark, transparent and distant surfaces and at grazing angles. A glossy
/// surface scatters little, and blinds the camera where it faces it. `parts` of the rendered scene.
[[nodiscard]] cv::Mat returnedLight(const RenderedFrame& image,
                                    const std::vector<SyntheticScene::Part>& parts);

/// Removes readings from `measured` (CV_32FC1 metres, 0 = none) where the windows that a camera matches hold
/// too little `light`. Holes get frayed rims, and readings near them err by some disparity steps.
/// Deterministic, as measureDepth().
void loseReadings(cv::Mat& measured, const cv::Mat& light, const KinectModel& model, std::uint32_t seed,
                  std::uint32_t frame);

}  // namespace scantrove::synthetic
