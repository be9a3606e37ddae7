#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Drops stray parts of a mask and closes pinholes in it, as an uneven border between labels leaves them:
/// what is far smaller than all of it. Its largest part stays, and what something nearer cuts off of it, and
/// the hole of a handle. `mask` (CV_8UC1, 255 = inside) fills `box_px`, which becomes that of what is left.
void dropSmallComponents(cv::Mat& mask, cv::Rect& box_px);

}  // namespace scantrove
