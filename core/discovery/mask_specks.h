#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Drops what an uneven border of labels leaves of a mask far away from it, and closes what it leaves open in
/// the middle: parts and holes far smaller than the whole. A part that something nearer cuts off stays, and
/// so does the hole of a handle. `mask` (CV_8UC1, 255 = inside) fills `box_px`, which becomes that of what is
/// left.
void dropSpecks(cv::Mat& mask, cv::Rect& box_px);

}  // namespace scantrove
