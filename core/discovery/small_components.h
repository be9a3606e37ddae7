#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Removes small components and closes small holes of a mask; uneven label borders cause both. Keeps the
/// largest component, parts that an occluder separates, and holes such as that of a handle. `mask` (CV_8UC1,
/// 255 = inside) fills `box_px`; both are cropped to the rest.
void dropSmallComponents(cv::Mat& mask, cv::Rect& box_px);

}  // namespace scantrove
