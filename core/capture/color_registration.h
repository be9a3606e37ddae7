#pragma once
#include <opencv2/core/mat.hpp>

#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

/// `color` (BGR) as the depth camera `K` would see it, were all the scene at the median distance of `depth`
/// (16-bit, in `metres_per_unit`): scaled and shifted as a whole, so that nothing tears. Nearer and farther
/// things keep an offset of fx * offset_x * (1 / z - 1 / z_median) pixels. What the colour camera did not see
/// repeats its border.
[[nodiscard]] cv::Mat registerColor(const cv::Mat& color, const ColorCamera& camera, const cv::Mat& depth,
                                    float metres_per_unit, const Intrinsics& K);

}  // namespace scantrove
