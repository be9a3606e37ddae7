#pragma once
#include <opencv2/core/mat.hpp>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// A colour camera beside the depth camera, looking the same way.
struct ColorCamera {
  float fx = 0, fy = 0, cx = 0, cy = 0;  ///< of the colour image
  float offset_x_m = 0;  ///< x of a point in the colour camera's frame less its x in the depth camera's
};

/// The first Kinect's pair without factory registration, as 7-Scenes recorded it: 525 pixels of focal length
/// for colour where depth has 585, 25 mm apart. Against the outlines of mugs and chairs of its kitchen this
/// is right to a few pixels.
inline constexpr ColorCamera kKinectColorCamera{525.0F, 525.0F, 320.0F, 240.0F, -0.025F};

/// `color` (BGR) as the depth camera `K` would see it, were all the scene at the median distance of `depth`
/// (16-bit, in `metres_per_unit`): scaled and shifted as a whole, so that nothing tears. Nearer and farther
/// things keep an offset of fx * offset_x * (1 / z - 1 / z_median) pixels. What the colour camera did not see
/// repeats its border.
[[nodiscard]] cv::Mat registerColor(const cv::Mat& color, const ColorCamera& camera, const cv::Mat& depth,
                                    float metres_per_unit, const Intrinsics& K);

}  // namespace scantrove
