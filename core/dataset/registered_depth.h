#pragma once
#include <opencv2/core/mat.hpp>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The measured depth as the key frame's colour camera sees it: CV_32FC1 of the colour image's size, metres
/// along its axis, 0 = no reading there. Every pixel of depth is a facet of the surface, joined to those of
/// its neighbours that are as deep, and open at depth edges; what another one hides from the colour camera is
/// left out. `depth`: CV_16UC1 of the size of K_depth. Where both cameras are one: the same numbers.
[[nodiscard]] cv::Mat registerDepth(const KeyFrameInfo& frame, const cv::Mat& depth);

}  // namespace scantrove
