#pragma once
#include <opencv2/core/mat.hpp>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The measured depth registered to the key frame's colour camera: CV_32FC1 of the colour image's size,
/// metres along its axis, 0 = no reading. Every depth pixel is a facet of the surface, joined to neighbours
/// of similar depth and open at depth edges. Surface hidden from the colour camera is left out. `depth`:
/// CV_16UC1 of the size of K_depth. If both cameras are one, values are unchanged.
[[nodiscard]] cv::Mat registerDepth(const KeyFrameInfo& frame, const cv::Mat& depth);

}  // namespace scantrove
